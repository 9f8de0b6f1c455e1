// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: Fortran interfaces of the BLAS and LAPACK that OpenBLAS holds, for which Debian
/// packs no header. Matrices stand column by column.
#pragma once

extern "C" {
void dtrsv_(const char* triangle, const char* transposed, const char* diagonal, const int* size,
            const double* matrix, const int* stride, double* values, const int* increment);
void dtrsm_(const char* side, const char* triangle, const char* transposed, const char* diagonal,
            const int* rows, const int* columns, const double* factor, const double* matrix,
            const int* stride, double* values, const int* values_stride);
void dgemv_(const char* transposed, const int* rows, const int* columns, const double* factor,
            const double* matrix, const int* stride, const double* x, const int* x_increment,
            const double* y_factor, double* y, const int* y_increment);
void dgemm_(const char* first_transposed, const char* second_transposed, const int* rows, const int* columns,
            const int* inner, const double* factor, const double* first, const int* first_stride,
            const double* second, const int* second_stride, const double* sum_factor, double* sum,
            const int* sum_stride);
void dsyrk_(const char* triangle, const char* transposed, const int* size, const int* inner,
            const double* factor, const double* matrix, const int* stride, const double* sum_factor,
            double* sum, const int* sum_stride);
void dpstrf_(const char* triangle, const int* size, double* matrix, const int* stride, int* pivots, int* rank,
             const double* tolerance, double* work, int* info);
void dtrmm_(const char* side, const char* triangle, const char* transposed, const char* diagonal,
            const int* rows, const int* columns, const double* factor, const double* matrix,
            const int* stride, double* values, const int* values_stride);
void dtrtri_(const char* triangle, const char* diagonal, const int* size, double* matrix, const int* stride,
             int* info);
void dlauum_(const char* triangle, const int* size, double* matrix, const int* stride, int* info);
void dgetrf_(const int* rows, const int* columns, double* matrix, const int* stride, int* pivots, int* info);
void dgetrs_(const char* transposed, const int* size, const int* right_sides, const double* factors,
             const int* stride, const int* pivots, double* values, const int* values_stride, int* info);
void dgecon_(const char* norm, const int* size, const double* factors, const int* stride,
             const double* matrix_norm, double* reciprocal_condition, double* work, int* integer_work,
             int* info);
void dpotrf_(const char* triangle, const int* size, double* matrix, const int* stride, int* info);
void dpotri_(const char* triangle, const int* size, double* matrix, const int* stride, int* info);
void dposv_(const char* triangle, const int* size, const int* right_sides, double* matrix, const int* stride,
            double* values, const int* values_stride, int* info);
void dsyevd_(const char* vectors, const char* triangle, const int* size, double* matrix, const int* stride,
             double* values, double* work, const int* work_size, int* integer_work, const int* integer_size,
             int* info);
void dsterf_(const int* size, double* diagonal, double* beside, int* info);
void dsygvd_(const int* kind, const char* vectors, const char* triangle, const int* size, double* matrix,
             const int* stride, double* mass, const int* mass_stride, double* values, double* work,
             const int* work_size, int* integer_work, const int* integer_size, int* info);
void dgeqrf_(const int* rows, const int* columns, double* matrix, const int* stride, double* factors,
             double* work, const int* work_size, int* info);
void dgeqp3_(const int* rows, const int* columns, double* matrix, const int* stride, int* pivots,
             double* factors, double* work, const int* work_size, int* info);
void dorgqr_(const int* rows, const int* columns, const int* reflections, double* matrix, const int* stride,
             const double* factors, double* work, const int* work_size, int* info);
void dormqr_(const char* side, const char* transposed, const int* rows, const int* columns,
             const int* reflections, const double* matrix, const int* stride, const double* factors,
             double* values, const int* values_stride, double* work, const int* work_size, int* info);
void dtzrzf_(const int* rows, const int* columns, double* matrix, const int* stride, double* factors,
             double* work, const int* work_size, int* info);
void dormrz_(const char* side, const char* transposed, const int* rows, const int* columns,
             const int* reflections, const int* beyond, const double* matrix, const int* stride,
             const double* factors, double* values, const int* values_stride, double* work,
             const int* work_size, int* info);
}
