// Abaqus' utility routines that user subroutines call: of our own, by the names that Fortran gives them.
#pragma once

namespace stillpoint {

/// Makes the routines visible to libraries that are loaded from now on.
void offer_umat_utilities();

/// Runs a body that may call XIT, which Abaqus has for a user subroutine that cannot go on. Returns false if it did:
/// the body has ended there. It must have no object that has to be destroyed.
bool runs_without_exit(void (*body)(void*), void* data);

}  // namespace stillpoint

// Tensors are components 11, 22, 33, 12, 13, 23, the first NDI normal and then NSHR shear ones; LSTR: 1 for stresses, 2
// for strains, whose shears are engineering ones. Matrices are stored column by column.
extern "C" {
/// SPRIME = R S Rᵀ.
void rotsig_(const double* S, const double* R, double* SPRIME, const int* LSTR, const int* NDI, const int* NSHR);
/// SINV1: the mean stress; SINV2: Mises' equivalent stress.
void sinv_(const double* STRESS, double* SINV1, double* SINV2, const int* NDI, const int* NSHR);
/// PS: the three principal values, from the smallest on.
void sprinc_(const double* S, double* PS, const int* LSTR, const int* NDI, const int* NSHR);
/// The same with AN(k, i), the direction cosine of PS(k) with axis i.
void sprind_(const double* S, double* PS, double* AN, const int* LSTR, const int* NDI, const int* NSHR);
/// Ends the run.
void xit_();
}
