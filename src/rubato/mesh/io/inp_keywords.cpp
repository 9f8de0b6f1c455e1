// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/inp_keywords.hpp"

#include "rubato/core/naming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <unordered_map>
#include <vector>

namespace rubato::mesh::inp {
namespace {

constexpr std::string_view no_material = "there is no such material";
constexpr std::string_view no_shells = "there are no shells, membranes, beams and trusses";
constexpr std::string_view no_heat = "heat and other fields are not computed";
constexpr std::string_view file_takes = "FREQUENCY,NSET,TIMEPOINTS";
constexpr std::string_view file_ignores =
    "OUTPUT,TOTALS,ELSET,GLOBAL,POSITION,DIRECTIONS,OUTPUTALL,LASTITERATIONS,CONTACTELEMENTS,"
    "OUTPUT3D,OUTPUT2D,SECTIONFORCES,FREQUENCYF";
constexpr std::string_view output_takes = "FREQUENCY,NSET,ELSET,VARIABLE,TIMEPOINTS";
constexpr std::string_view output_ignores =
    "OUTPUT,TOTALS,GLOBAL,POSITION,DIRECTIONS,OUTPUTALL,LASTITERATIONS,CONTACTELEMENTS,OUTPUT3D,"
    "OUTPUT2D,SECTIONFORCES,FREQUENCYF,EXTERIOR,MASTER,SLAVE,SURFACE,CPSET,GENERALCONTACT,REBAR,TRACERSET";
constexpr std::string_view no_flow = "fluids are not computed";
constexpr std::string_view no_script = "its work is done with a deck (rubato deck)";
constexpr std::string_view no_user = "there are no user subroutines";
constexpr std::string_view other_step = "there is no such analysis";
constexpr std::string_view elsewhere = "write the numbers into the file";

constexpr Keyword keyword_rows[] = {
    // ---- what others stand in
    Keyword{"ASSEMBLY", Use::structure, "NAME", "", "parts at their places"},
    Keyword{"END ASSEMBLY", Use::structure},
    Keyword{"END INSTANCE", Use::structure},
    Keyword{"END PART", Use::structure},
    Keyword{"END STEP", Use::structure},
    Keyword{"INCLUDE", Use::structure, "INPUT", "", "the lines of another file"},
    Keyword{"INSTANCE", Use::structure, "NAME,PART", "", "a part, moved and turned"},
    Keyword{"PART", Use::structure, "NAME", "", "nodes, cells, groups of an instance"},
    Keyword{"STEP", Use::structure, "NAME,NLGEOM,AMPLITUDE,PERTURBATION",
            "INC,INCF,UNSYMM,CONVERTSDI,EXTRAPOLATION", "a run; it starts from the end of the one before"},
    // ---- mesh
    Keyword{"ELCOPY", Use::mesh, "ELEMENTSHIFT,OLDSET,SHIFTNODES,NEWSET", "", "cells"},
    Keyword{"ELGEN", Use::mesh, "ELSET", "ALLNODES", "cells"},
    Keyword{"ELEMENT", Use::mesh, "TYPE,ELSET,INPUT", "", "cells"},
    Keyword{"ELSET", Use::mesh, "ELSET,GENERATE,INSTANCE", "INTERNAL,UNSORTED", "groups of cells"},
    Keyword{"NCOPY", Use::mesh, "CHANGENUMBER,OLDSET,NEWSET,SHIFT,MULTIPLE", "", "nodes"},
    Keyword{"NFILL", Use::mesh, "NSET,BIAS", "", "nodes"},
    Keyword{"NGEN", Use::mesh, "NSET,LINE", "", "nodes"},
    Keyword{"NODE", Use::mesh, "NSET,SYSTEM,INPUT", "", "nodes"},
    Keyword{"NSET", Use::mesh, "NSET,ELSET,GENERATE,INSTANCE", "INTERNAL,UNSORTED", "groups of nodes"},
    Keyword{"SURFACE", Use::mesh, "NAME,TYPE,INSTANCE", "INTERNAL", "groups of faces, or of nodes"},
    Keyword{"SYSTEM", Use::mesh, "", "", "axes of the nodes that follow"},
    // ---- materials and sections
    Keyword{"CREEP", Use::study, "", "LAW,TIME", "nothing: it is active in *VISCO only"},
    Keyword{"CYCLIC HARDENING", Use::study, "PARAMETERS", "", "materials: hardening"},
    Keyword{"DAMPING", Use::study, "ALPHA,BETA", "", "materials: rayleigh"},
    Keyword{"DENSITY", Use::study, "", "", "materials: density"},
    Keyword{"ELASTIC", Use::study, "TYPE,MODULI", "", "materials: elastic, orthotropic"},
    Keyword{"EXPANSION", Use::study, "TYPE,ZERO", "", "materials: expansion"},
    Keyword{"HYPERELASTIC", Use::study,
            "N,NEOHOOKE,MOONEYRIVLIN,YEOH,OGDEN,POLYNOMIAL,REDUCEDPOLYNOMIAL,ARRUDABOYCE,MARLOW,VANDERWAALS,"
            "USER,TESTDATAINPUT",
            "MODULI", "materials: hyperelastic, yeoh, ogden"},
    Keyword{"MATERIAL", Use::study, "NAME", "SRATEFACTOR", "materials"},
    Keyword{"ORIENTATION", Use::study, "NAME,SYSTEM,DEFINITION", "LOCALDIRECTIONS",
            "materials: angles, axes"},
    Keyword{"PLASTIC", Use::study, "HARDENING,DATATYPE,NUMBERBACKSTRESSES,RATE", "", "materials: plastic"},
    Keyword{"RATE DEPENDENT", Use::study, "TYPE", "", "materials: hardening: johnson_cook"},
    Keyword{"SOLID SECTION", Use::study, "ELSET,MATERIAL,ORIENTATION", "CONTROLS,STACKDIRECTION,SYMMETRIC",
            "materials: cells; thickness"},
    Keyword{"VISCOELASTIC", Use::study, "TIME", "", "materials: prony"},
    // ---- loads and supports
    Keyword{"AMPLITUDE", Use::study,
            "NAME,TIME,DEFINITION,VALUE,SMOOTH,FIXEDINTERVAL,BEGIN,SHIFTX,SHIFTY,INPUT", "", "functions"},
    Keyword{"BOUNDARY", Use::study, "OP,AMPLITUDE,TYPE,FIXED", "", "supports"},
    Keyword{"CLOAD", Use::study, "OP,AMPLITUDE", "", "loads: nodal_force, moment"},
    Keyword{"DLOAD", Use::study, "OP,AMPLITUDE", "", "loads: pressure, gravity"},
    Keyword{"DSLOAD", Use::study, "OP,AMPLITUDE,FOLLOWER,CONSTANTRESULTANT", "",
            "loads: pressure, surface_force"},
    Keyword{"INITIAL CONDITIONS", Use::study, "TYPE", "", "initial, reference_temperature"},
    Keyword{"TEMPERATURE", Use::study, "OP,AMPLITUDE", "", "temperature"},
    // ---- constraints and parts that are no cells
    Keyword{"COUPLING", Use::study, "CONSTRAINTNAME,REFNODE,SURFACE,ORIENTATION", "",
            "relations: rigid, distributed, equation"},
    Keyword{"DASHPOT", Use::study, "ELSET", "", "connectors: damping"},
    Keyword{"DISTRIBUTING", Use::study, "WEIGHTINGMETHOD,COUPLING,CYCLICSYMMETRY", "",
            "relations: distributed, equation"},
    Keyword{"DISTRIBUTING COUPLING", Use::study, "REFNODE,ELSET", "", "relations: equation"},
    Keyword{"EMBEDDED ELEMENT", Use::study, "HOSTELSET",
            "ABSOLUTEEXTERIORTOLERANCE,EXTERIORTOLERANCE,ROUNDOFFTOLERANCE", "relations: embedded"},
    Keyword{"EQUATION", Use::study, "INPUT", "", "relations: equation"},
    Keyword{"GAP", Use::study, "ELSET", "", "connectors: force"},
    Keyword{"KINEMATIC", Use::study, "", "", "relations: rigid"},
    Keyword{"KINEMATIC COUPLING", Use::study, "REFNODE,ORIENTATION", "", "relations: rigid, equation"},
    Keyword{"MASS", Use::study, "ELSET", "TYPE", "masses"},
    Keyword{"MPC", Use::study, "", "", "relations: equation"},
    Keyword{"PRE-TENSION SECTION", Use::study, "SURFACE,NODE", "", "preload"},
    Keyword{"RIGID BODY", Use::study, "REFNODE,ROTNODE,NSET,ELSET,TIENSET", "", "relations: rigid"},
    Keyword{"SPRING", Use::study, "ELSET,NONLINEAR", "", "connectors: stiffness, force"},
    Keyword{"TIE", Use::study, "NAME,ADJUST,TYPE,POSITIONTOLERANCE", "NOROTATION", "contact: tie"},
    Keyword{"TRANSFORM", Use::study, "NSET,TYPE", "", "supports: along; loads, relations"},
    // ---- contact
    Keyword{"CLEARANCE", Use::study, "MASTER,SLAVE,VALUE", "", "contact: gap"},
    Keyword{"CONTACT", Use::study, "", "", "contact: all, between"},
    Keyword{"CONTACT INCLUSIONS", Use::study, "ALLEXTERIOR", "", "contact: all, between"},
    Keyword{"CONTACT PAIR", Use::study, "INTERACTION,TYPE,SMALLSLIDING,TIED,ADJUST",
            "MECHANICALCONSTRAINT,TRACKING", "contact: master, slave"},
    Keyword{"CONTACT PROPERTY ASSIGNMENT", Use::study, "", "", "contact: numbers of all"},
    Keyword{"FRICTION", Use::study, "LAGRANGE,SLIPTOLERANCE,ELASTICSLIP", "", "contact: friction"},
    Keyword{"SURFACE BEHAVIOR", Use::study,
            "PRESSUREOVERCLOSURE,NOSEPARATION,PENALTY,DIRECT,AUGMENTEDLAGRANGE", "", "contact: method"},
    Keyword{"SURFACE INTERACTION", Use::study, "NAME", "", "contact"},
    // ---- steps
    Keyword{"CHANGE CONTACT TYPE", Use::study, "",
            "TO,TONODETOSURFACE,TOSURFACETOSURFACE,TOMASSLESS,TOMORTAR,INTERACTION", "nothing"},
    Keyword{"CHANGE FRICTION", Use::study, "INTERACTION", "", "contact: friction of a step"},
    Keyword{"CHANGE MATERIAL", Use::study, "NAME", "", "materials of a step"},
    Keyword{"CHANGE PLASTIC", Use::study, "HARDENING", "", "materials: hardening of a step"},
    Keyword{"CHANGE SURFACE BEHAVIOR", Use::study, "INTERACTION", "", "contact: method of a step"},
    Keyword{"DYNAMIC", Use::study, "ALPHA,DIRECT,EXPLICIT,APPLICATION",
            "NOHAF,HAFTOL,INITIAL,SOLVER,HALFINCSCALEFACTOR", "time: hht, central_difference"},
    Keyword{"FREQUENCY", Use::study, "EIGENSOLVER,SOLVER", "NORMALIZATION,STORAGE,GLOBAL", "rubato modes"},
    Keyword{"MODEL CHANGE", Use::study, "TYPE,ADD,REMOVE", "", "contact: pairs that are open for a while"},
    Keyword{"STATIC", Use::study, "DIRECT,STABILIZE", "SOLVER,ALLSDTOL,CONTINUE,FACTOR", "time: static"},
    Keyword{"VISCO", Use::study, "DIRECT,STABILIZE", "SOLVER,CETOL,ALLSDTOL,CONTINUE,FACTOR", "time: static"},
    // ---- results
    Keyword{"CONTACT FILE", Use::study, file_takes, file_ignores, "fields"},
    Keyword{"CONTACT OUTPUT", Use::study, output_takes, output_ignores, "fields, fields: tables"},
    Keyword{"CONTACT PRINT", Use::study, "SLAVE,MASTER,FREQUENCY,TIMEPOINTS",
            "TOTALS,NSET,SUMMARY,FREQUENCYF", "fields: tables"},
    Keyword{"EL FILE", Use::study, file_takes, file_ignores, "fields"},
    Keyword{"EL PRINT", Use::study, "ELSET,TOTALS,FREQUENCY,GLOBAL,TIMEPOINTS",
            "POSITION,SUMMARY,FREQUENCYF,REBAR,MODE,LASTMODE", "fields: tables"},
    Keyword{"ELEMENT OUTPUT", Use::study, output_takes, output_ignores, "fields, fields: tables"},
    Keyword{"NODE FILE", Use::study, file_takes, file_ignores, "fields"},
    Keyword{"NODE OUTPUT", Use::study, output_takes, output_ignores, "fields, probes, fields: tables"},
    Keyword{"NODE PRINT", Use::study, "NSET,TOTALS,FREQUENCY,GLOBAL,TIMEPOINTS",
            "SUMMARY,FREQUENCYF,EXTERIOR,MODE,LASTMODE", "probes, fields: tables"},
    Keyword{"OUTPUT", Use::study, "FIELD,HISTORY,FREQUENCY,TIMEINTERVAL,NUMBERINTERVAL,TIMEPOINTS",
            "VARIABLE,TIMEMARKS,OP,NAME,SENSOR", "fields"},
    Keyword{"SECTION PRINT", Use::study, "SURFACE,NAME,FREQUENCY,TIMEPOINTS", "FREQUENCYF,AXES,UPDATE",
            "fields: tables"},
    Keyword{"TIME POINTS", Use::study, "NAME,TIME,GENERATE", "", "fields: at"},
    // ---- harmless
    Keyword{"CONDUCTIVITY", Use::harmless},
    Keyword{"CONTACT CONTROLS", Use::harmless},
    Keyword{"CONTROLS", Use::harmless},
    Keyword{"DIAGNOSTICS", Use::harmless},
    Keyword{"ENERGY FILE", Use::harmless},
    Keyword{"ENERGY OUTPUT", Use::harmless},
    Keyword{"ENERGY PRINT", Use::harmless},
    Keyword{"FILE FORMAT", Use::harmless},
    Keyword{"FILE OUTPUT", Use::harmless},
    Keyword{"FILTER", Use::harmless},
    Keyword{"HEADING", Use::harmless},
    Keyword{"HOURGLASS STIFFNESS", Use::harmless},
    Keyword{"INTEGRATED OUTPUT", Use::harmless},
    Keyword{"INTEGRATED OUTPUT SECTION", Use::harmless},
    Keyword{"MODAL OUTPUT", Use::harmless},
    Keyword{"MONITOR", Use::harmless},
    Keyword{"PREPRINT", Use::harmless},
    Keyword{"PRINT", Use::harmless},
    Keyword{"RESTART", Use::harmless},
    Keyword{"SECTION CONTROLS", Use::harmless},
    Keyword{"SECTION FILE", Use::harmless},
    Keyword{"SOLVER CONTROLS", Use::harmless},
    Keyword{"SPECIFIC HEAT", Use::harmless},
    Keyword{"SURFACE OUTPUT", Use::harmless},
    Keyword{"USER OUTPUT VARIABLES", Use::harmless},
    // ---- not available
    Keyword{"ACOUSTIC MEDIUM", Use::unavailable, "", "", no_flow},
    Keyword{"ADAPTIVE MESH", Use::unavailable},
    Keyword{"ANNEAL", Use::unavailable, "", "", other_step},
    Keyword{"ANISOTROPIC HYPERELASTIC", Use::unavailable, "", "", no_material},
    Keyword{"BASE MOTION", Use::unavailable, "", "", no_script},
    Keyword{"BEAM GENERAL SECTION", Use::unavailable, "", "", no_shells},
    Keyword{"BEAM SECTION", Use::unavailable, "", "", no_shells},
    Keyword{"BLACKBODY", Use::unavailable, "", "", no_heat},
    Keyword{"BRITTLE CRACKING", Use::unavailable, "", "", no_material},
    Keyword{"BUCKLE", Use::unavailable, "", "", other_step},
    Keyword{"BULK VISCOSITY", Use::unavailable},
    Keyword{"CAP PLASTICITY", Use::unavailable, "", "", no_material},
    Keyword{"CAST IRON PLASTICITY", Use::unavailable, "", "", no_material},
    Keyword{"CFLUX", Use::unavailable, "", "", no_heat},
    Keyword{"CHANGE SOLID SECTION", Use::unavailable},
    Keyword{"CLAY PLASTICITY", Use::unavailable, "", "", no_material},
    Keyword{"COHESIVE BEHAVIOR", Use::unavailable},
    Keyword{"COHESIVE SECTION", Use::unavailable},
    Keyword{"COMPLEX FREQUENCY", Use::unavailable, "", "", other_step},
    Keyword{"CONCRETE", Use::unavailable, "", "", no_material},
    Keyword{"CONCRETE DAMAGED PLASTICITY", Use::unavailable, "", "", no_material},
    Keyword{"CONNECTOR BEHAVIOR", Use::unavailable},
    Keyword{"CONNECTOR DAMPING", Use::unavailable},
    Keyword{"CONNECTOR ELASTICITY", Use::unavailable},
    Keyword{"CONNECTOR LOAD", Use::unavailable},
    Keyword{"CONNECTOR MOTION", Use::unavailable},
    Keyword{"CONNECTOR SECTION", Use::unavailable},
    Keyword{"CONSTRAINT CONTROLS", Use::unavailable},
    Keyword{"CONTACT CLEARANCE", Use::unavailable, "", "", no_script},
    Keyword{"CONTACT CLEARANCE ASSIGNMENT", Use::unavailable, "", "", no_script},
    Keyword{"CONTACT CONTROLS ASSIGNMENT", Use::unavailable},
    Keyword{"CONTACT DAMPING", Use::unavailable},
    Keyword{"CONTACT EXCLUSIONS", Use::unavailable, "", "", no_script},
    Keyword{"CONTACT FORMULATION", Use::unavailable},
    Keyword{"CONTACT INITIALIZATION ASSIGNMENT", Use::unavailable},
    Keyword{"CONTACT INITIALIZATION DATA", Use::unavailable},
    Keyword{"CONTACT INTERFERENCE", Use::unavailable, "", "", no_script},
    Keyword{"CONTACT STABILIZATION", Use::unavailable},
    Keyword{"CORRELATION", Use::unavailable},
    Keyword{"COUPLED TEMPERATURE-DISPLACEMENT", Use::unavailable, "", "", no_heat},
    Keyword{"CRACK PROPAGATION", Use::unavailable},
    Keyword{"CYCLIC", Use::unavailable, "", "", no_material},
    Keyword{"CYCLIC SYMMETRY MODEL", Use::unavailable},
    Keyword{"D ADDED MASS", Use::unavailable},
    Keyword{"DAMAGE EVOLUTION", Use::unavailable, "", "", no_material},
    Keyword{"DAMAGE INITIATION", Use::unavailable, "", "", no_material},
    Keyword{"DEBOND", Use::unavailable},
    Keyword{"DEFORMATION PLASTICITY", Use::unavailable, "", "", no_material},
    Keyword{"DEPVAR", Use::unavailable, "", "", no_user},
    Keyword{"DESIGN VARIABLES", Use::unavailable},
    Keyword{"DFLUX", Use::unavailable, "", "", no_heat},
    Keyword{"DIRECT CYCLIC", Use::unavailable, "", "", other_step},
    Keyword{"DISTRIBUTION", Use::unavailable, "", "", no_script},
    Keyword{"DISTRIBUTION TABLE", Use::unavailable, "", "", no_script},
    Keyword{"DRUCKER PRAGER", Use::unavailable, "", "", no_material},
    Keyword{"DSFLUX", Use::unavailable, "", "", no_heat},
    Keyword{"DYNAMIC TEMPERATURE-DISPLACEMENT", Use::unavailable, "", "", no_heat},
    Keyword{"ELECTRICAL CONDUCTIVITY", Use::unavailable, "", "", no_heat},
    Keyword{"ELECTROMAGNETICS", Use::unavailable, "", "", no_heat},
    Keyword{"EOS", Use::unavailable, "", "", no_material},
    Keyword{"EXTREME VALUE", Use::unavailable},
    Keyword{"FASTENER", Use::unavailable},
    Keyword{"FIELD", Use::unavailable},
    Keyword{"FILM", Use::unavailable, "", "", no_heat},
    Keyword{"FLUID CONSTANTS", Use::unavailable, "", "", no_flow},
    Keyword{"FLUID SECTION", Use::unavailable, "", "", no_flow},
    Keyword{"FOUNDATION", Use::unavailable, "", "", no_script},
    Keyword{"FRACTURE CRITERION", Use::unavailable},
    Keyword{"GAP CONDUCTANCE", Use::unavailable, "", "", no_heat},
    Keyword{"GAP HEAT GENERATION", Use::unavailable, "", "", no_heat},
    Keyword{"GAP UNIT", Use::unavailable, "", "", no_script},
    Keyword{"GASKET BEHAVIOR", Use::unavailable},
    Keyword{"GASKET SECTION", Use::unavailable},
    Keyword{"GEOSTATIC", Use::unavailable, "", "", other_step},
    Keyword{"GREEN", Use::unavailable, "", "", other_step},
    Keyword{"HCF", Use::unavailable, "", "", other_step},
    Keyword{"HEAT GENERATION", Use::unavailable, "", "", no_heat},
    Keyword{"HEAT TRANSFER", Use::unavailable, "", "", no_heat},
    Keyword{"HYPERFOAM", Use::unavailable, "", "", no_material},
    Keyword{"HYPOELASTIC", Use::unavailable, "", "", no_material},
    Keyword{"HYSTERESIS", Use::unavailable, "", "", no_material},
    Keyword{"IMPERFECTION", Use::unavailable},
    Keyword{"IMPORT", Use::unavailable},
    Keyword{"INCIDENT WAVE", Use::unavailable, "", "", no_flow},
    Keyword{"INELASTIC HEAT FRACTION", Use::unavailable, "", "", no_heat},
    Keyword{"INERTIA RELIEF", Use::unavailable},
    Keyword{"JOINT", Use::unavailable},
    Keyword{"JOINTED MATERIAL", Use::unavailable, "", "", no_material},
    Keyword{"LOAD CASE", Use::unavailable},
    Keyword{"MASS DIFFUSION", Use::unavailable, "", "", no_heat},
    Keyword{"MASS FLOW", Use::unavailable, "", "", no_flow},
    Keyword{"MASS SCALING", Use::unavailable},
    Keyword{"MATRIX ASSEMBLE", Use::unavailable},
    Keyword{"MATRIX INPUT", Use::unavailable},
    Keyword{"MEMBRANE SECTION", Use::unavailable, "", "", no_shells},
    Keyword{"MODAL DAMPING", Use::unavailable, "", "", no_script},
    Keyword{"MODAL DYNAMIC", Use::unavailable, "", "", other_step},
    Keyword{"MOHR COULOMB", Use::unavailable, "", "", no_material},
    Keyword{"MOHR COULOMB HARDENING", Use::unavailable, "", "", no_material},
    Keyword{"MOTION", Use::unavailable},
    Keyword{"MULLINS EFFECT", Use::unavailable, "", "", no_material},
    Keyword{"NETWORK MPC", Use::unavailable, "", "", no_flow},
    Keyword{"NMAP", Use::unavailable, "", "", elsewhere},
    Keyword{"NO COMPRESSION", Use::unavailable, "", "", no_material},
    Keyword{"NO TENSION", Use::unavailable, "", "", no_material},
    Keyword{"NODAL THICKNESS", Use::unavailable, "", "", no_shells},
    Keyword{"NONSTRUCTURAL MASS", Use::unavailable, "", "", no_script},
    Keyword{"NORMAL", Use::unavailable},
    Keyword{"OBJECTIVE", Use::unavailable},
    Keyword{"PARAMETER", Use::unavailable, "", "", elsewhere},
    Keyword{"PERIODIC", Use::unavailable},
    Keyword{"PERMEABILITY", Use::unavailable, "", "", no_flow},
    Keyword{"PERMANENT SET", Use::unavailable, "", "", no_material},
    Keyword{"PHYSICAL CONSTANTS", Use::unavailable, "", "", no_heat},
    Keyword{"PIEZOELECTRIC", Use::unavailable, "", "", no_heat},
    Keyword{"POROUS ELASTIC", Use::unavailable, "", "", no_material},
    Keyword{"POROUS METAL PLASTICITY", Use::unavailable, "", "", no_material},
    Keyword{"POTENTIAL", Use::unavailable, "", "", no_material},
    Keyword{"RADIATE", Use::unavailable, "", "", no_heat},
    Keyword{"RANDOM RESPONSE", Use::unavailable, "", "", other_step},
    Keyword{"REBAR", Use::unavailable, "", "", no_shells},
    Keyword{"REBAR LAYER", Use::unavailable, "", "", no_shells},
    Keyword{"REFINE MESH", Use::unavailable, "", "", no_script},
    Keyword{"RELEASE", Use::unavailable, "", "", no_shells},
    Keyword{"RESPONSE SPECTRUM", Use::unavailable, "", "", other_step},
    Keyword{"RETAINED NODAL DOFS", Use::unavailable, "", "", other_step},
    Keyword{"RIGID SURFACE", Use::unavailable, "", "",
            "write contact with an obstacle in a deck (rubato deck)"},
    Keyword{"ROBUST DESIGN", Use::unavailable},
    Keyword{"ROTARY INERTIA", Use::unavailable, "", "", no_script},
    Keyword{"SENSITIVITY", Use::unavailable, "", "", other_step},
    Keyword{"SHELL GENERAL SECTION", Use::unavailable, "", "", no_shells},
    Keyword{"SHELL SECTION", Use::unavailable, "", "", no_shells},
    Keyword{"SHELL TO SOLID COUPLING", Use::unavailable, "", "", no_shells},
    Keyword{"SOILS", Use::unavailable, "", "", no_flow},
    Keyword{"SPECIFIC GAS CONSTANT", Use::unavailable, "", "", no_flow},
    Keyword{"STEADY STATE DYNAMICS", Use::unavailable, "", "", other_step},
    Keyword{"STEADY STATE TRANSPORT", Use::unavailable, "", "", other_step},
    Keyword{"SUBMODEL", Use::unavailable},
    Keyword{"SUBSTRUCTURE GENERATE", Use::unavailable, "", "", other_step},
    Keyword{"SUBSTRUCTURE LOAD CASE", Use::unavailable},
    Keyword{"SUBSTRUCTURE PATH", Use::unavailable},
    Keyword{"SUPER ELASTIC", Use::unavailable, "", "", no_material},
    Keyword{"SURFACE FLAW", Use::unavailable},
    Keyword{"SURFACE SECTION", Use::unavailable, "", "", no_shells},
    Keyword{"SWELLING", Use::unavailable, "", "", no_material},
    Keyword{"SYMMETRIC MODEL GENERATION", Use::unavailable, "", "", elsewhere},
    Keyword{"TRIAXIAL TEST DATA", Use::unavailable, "", "", no_material},
    Keyword{"TRS", Use::unavailable, "", "", no_material},
    Keyword{"UNCOUPLED TEMPERATURE-DISPLACEMENT", Use::unavailable, "", "", no_heat},
    Keyword{"UNIAXIAL TEST DATA", Use::unavailable, "", "", no_material},
    Keyword{"USER DEFINED FIELD", Use::unavailable, "", "", no_user},
    Keyword{"USER ELEMENT", Use::unavailable, "", "", no_user},
    Keyword{"USER MATERIAL", Use::unavailable, "", "", no_user},
    Keyword{"VALUES AT INFINITY", Use::unavailable, "", "", no_flow},
    Keyword{"VIEWFACTOR", Use::unavailable, "", "", no_heat},
    Keyword{"VISCOUS", Use::unavailable, "", "", no_material},
};

} // namespace

std::span<const Keyword> all_keywords() {
  return keyword_rows;
}

std::string compact(std::string_view text) {
  auto word = folded(text);
  std::erase_if(word, [](char letter) { return letter == '-' || letter == '_'; });
  return word;
}

std::string folded(std::string_view label) {
  std::string word;
  for (const char letter : label)
    if (letter != ' ' && letter != '\t')
      word += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return word;
}

const Keyword* keyword_named(std::string_view name) {
  static const auto by_name = [] {
    std::unordered_map<std::string, const Keyword*> all;
    for (const auto& row : keyword_rows)
      all.emplace(compact(row.name), &row);
    return all;
  }();
  const auto found = by_name.find(compact(name));
  return found == by_name.end() ? nullptr : found->second;
}

std::string nearest_keyword(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& row : keyword_rows)
    names.emplace_back(row.name);
  const auto nearest = nearest_word(std::string(name.substr(0, 60)), names);
  return nearest.empty() ? "" : fmt::format("; did you mean '*{}'?", nearest);
}

} // namespace rubato::mesh::inp
