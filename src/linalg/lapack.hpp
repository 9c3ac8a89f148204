// The few BLAS/LAPACK routines in use (Fortran symbols, 32-bit integers; every argument by address, column-major).
#pragma once

extern "C" {
/// C = alpha op(A) op(B) + beta C
void dgemm_(const char* trans_a, const char* trans_b, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c,
            const int* ldc);
/// B = alpha op(A)^-1 B or alpha B op(A)^-1, A triangular.
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
/// A = P L U
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivot, int* info);
/// Solves A X = B or A^T X = B from dgetrf's factors.
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* a, const int* lda, const int* pivot,
             double* b, const int* ldb, int* info);
/// 1 / (|A| |A^-1|) in the 1-norm or the infinity norm from dgetrf's factors.
void dgecon_(const char* norm, const int* n, const double* a, const int* lda, const double* anorm, double* rcond,
             double* work, int* iwork, int* info);
/// Chosen eigenvalues and eigenvectors of a symmetric tridiagonal matrix.
void dstevx_(const char* jobz, const char* range, const int* n, double* d, double* e, const double* vl,
             const double* vu, const int* il, const int* iu, const double* abstol, int* m, double* w, double* z,
             const int* ldz, double* work, int* iwork, int* ifail, int* info);
/// Eigenvalues and eigenvectors of a symmetric matrix, which the vectors replace.
void dsyev_(const char* jobz, const char* uplo, const int* n, double* a, const int* lda, double* w, double* work,
            const int* lwork, int* info);
void openblas_set_num_threads(int count);
int openblas_get_num_threads();
/// Name of the processor family whose kernels OpenBLAS uses.
char* openblas_get_corename();
}
