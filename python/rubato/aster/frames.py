# SPDX-License-Identifier: LGPL-3.0-or-later
"""Components of vectors and symmetric tensors in other axes (REPERE), and invariants of tensors."""

from __future__ import annotations

import numpy as np

VECTORS = (("DX", "DY", "DZ"), ("FX", "FY", "FZ"), ("X", "Y", "Z"))
# A family of tensor components is its first letters; "SIXX", "EPXY".
TENSORS = ("SI", "EP")
PAIRS = ((0, 0, "XX"), (1, 1, "YY"), (2, 2, "ZZ"), (0, 1, "XY"), (0, 2, "XZ"), (1, 2, "YZ"))


def turned(components: tuple[str, ...], values: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Values of rows × components in the axes of each row: rows × 3 × 3, an axis a row of the matrix. Components of
    no vector or tensor stay."""
    result = values.copy()
    for names in VECTORS:
        if names[0] in components:
            turned_vector = np.einsum("nij,nj->ni", axes, _gathered(components, values, names))
            _scatter(components, result, names, turned_vector)
    for letters in TENSORS:
        if letters + "XX" in components:
            tensor = axes @ tensor_of(components, values, letters) @ np.swapaxes(axes, 1, 2)
            for i, j, pair in PAIRS:
                if letters + pair in components:
                    result[:, components.index(letters + pair)] = tensor[:, i, j]
    return result


def _gathered(components: tuple[str, ...], values: np.ndarray, names: tuple[str, ...]) -> np.ndarray:
    columns = [values[:, components.index(name)] if name in components else np.zeros(len(values)) for name in names]
    return np.column_stack(columns)


def _scatter(components: tuple[str, ...], result: np.ndarray, names: tuple[str, ...], vector: np.ndarray) -> None:
    for axis, name in enumerate(names):
        if name in components:
            result[:, components.index(name)] = vector[:, axis]


def tensor_of(components: tuple[str, ...], values: np.ndarray, letters: str) -> np.ndarray:
    """Rows × 3 × 3; components that the field lacks are 0."""
    tensor = np.zeros((len(values), 3, 3))
    for i, j, pair in PAIRS:
        if letters + pair in components:
            tensor[:, i, j] = tensor[:, j, i] = values[:, components.index(letters + pair)]
    return tensor


# ---- axes ------------------------------------------------------------------------------------------------------


def along_line(points: np.ndarray) -> np.ndarray:
    """LOCAL: the first axis runs along the line of points, in its plane z; the second is to its left. At inner points
    the mean of the axes of both sides, as Code_Aster takes it, without making its length 1."""
    steps = np.diff(points, axis=0)
    tangents = steps[:, :2] / np.linalg.norm(steps, axis=1)[:, None]
    at_points = np.vstack([tangents[:1], 0.5 * (tangents[1:] + tangents[:-1]), tangents[-1:]])
    axes = np.zeros((len(points), 3, 3))
    axes[:, 0, :2] = at_points
    axes[:, 1, 0], axes[:, 1, 1] = -at_points[:, 1], at_points[:, 0]
    axes[:, 2, 2] = 1.0
    return axes


def around_axis(points: np.ndarray, origin: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """CYLINDRIQUE, POLAIRE: r, θ, z about an axis. On the axis r is x, or y where x is along the axis."""
    z = axis / np.linalg.norm(axis)
    arms = points - origin
    radial = arms - np.outer(arms @ z, z)
    lengths = np.linalg.norm(radial, axis=1)
    other = np.eye(3)[0] if abs(z[0]) < 0.9 else np.eye(3)[1]
    fallback = other - (other @ z) * z
    on_axis = lengths <= 1e-12 * max(1.0, float(np.max(np.abs(points), initial=0.0)))
    radial[on_axis] = fallback
    radial /= np.linalg.norm(radial, axis=1)[:, None]
    return np.stack([radial, np.cross(z, radial), np.broadcast_to(z, radial.shape)], axis=1)


def by_angles(degrees: tuple[float, ...], count: int) -> np.ndarray:
    """UTILISATEUR: axes turned about z, then about the new y (upwards for a negative angle), then about the new x."""
    alpha, beta, gamma = np.radians((*degrees, 0.0, 0.0)[:3])
    ca, sa, cb, sb, cg, sg = np.cos(alpha), np.sin(alpha), np.cos(beta), np.sin(beta), np.cos(gamma), np.sin(gamma)
    axes = np.array([
        [cb * ca, cb * sa, -sb],
        [sg * sb * ca - cg * sa, cg * ca + sg * sb * sa, sg * cb],
        [sg * sa + cg * sb * ca, cg * sb * sa - sg * ca, cg * cb],
    ])
    return np.broadcast_to(axes, (count, 3, 3))


# ---- invariants ------------------------------------------------------------------------------------------------

STRESS_INVARIANTS = ("VMIS", "TRESCA", "PRIN_1", "PRIN_2", "PRIN_3", "VMIS_SG", "VECT_1_X", "VECT_1_Y", "VECT_1_Z",
                     "VECT_2_X", "VECT_2_Y", "VECT_2_Z", "VECT_3_X", "VECT_3_Y", "VECT_3_Z", "TRSIG", "TRIAX")
STRAIN_INVARIANTS = ("INVA_2", "PRIN_1", "PRIN_2", "PRIN_3", "INVA_2SG", "VECT_1_X", "VECT_1_Y", "VECT_1_Z",
                     "VECT_2_X", "VECT_2_Y", "VECT_2_Z", "VECT_3_X", "VECT_3_Y", "VECT_3_Z")


def stress_invariants(tensor: np.ndarray) -> np.ndarray:
    """Rows × STRESS_INVARIANTS. Principal values ascend."""
    principal, vectors, trace, deviator = _spectrum(tensor)
    mises = np.sqrt(1.5) * deviator
    tresca = principal[:, 2] - principal[:, 0]
    ratio = np.divide(trace / 3, mises, out=np.zeros_like(trace), where=mises > 0)
    return np.column_stack([mises, tresca, principal, _signed(mises, trace), vectors, trace, ratio])


def strain_invariants(tensor: np.ndarray) -> np.ndarray:
    """Rows × STRAIN_INVARIANTS. INVA_2 is √(2/3 e:e) of the deviator e."""
    principal, vectors, trace, deviator = _spectrum(tensor)
    second = np.sqrt(2 / 3) * deviator
    return np.column_stack([second, principal, _signed(second, trace), vectors])


def _spectrum(tensor: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    principal, vectors = np.linalg.eigh(tensor)
    trace = np.trace(tensor, axis1=1, axis2=2)
    deviator = tensor - trace[:, None, None] / 3 * np.eye(3)
    size = np.sqrt(np.einsum("nij,nij->n", deviator, deviator))
    return principal, np.swapaxes(vectors, 1, 2).reshape(len(tensor), 9), trace, size


def _signed(size: np.ndarray, trace: np.ndarray) -> np.ndarray:
    return np.where(trace < 0, -size, size)
