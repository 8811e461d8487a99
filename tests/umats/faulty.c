/* Hooke's law of E = 1e4, nu = 0, with one fault, which a macro chooses. */
#include <math.h>
#include <stddef.h>

void xit_(void);
void is_nowhere_(void);

#ifndef NAME
#define NAME umat_
#endif

void NAME(double* STRESS, double* STATEV, double* DDSDDE, double* SSE, double* SPD, double* SCD, double* RPL,
          double* DDSDDT, double* DRPLDE, double* DRPLDT, double* STRAN, double* DSTRAN, double* TIME, double* DTIME,
          double* TEMP, double* DTEMP, double* PREDEF, double* DPRED, char* CMNAME, int* NDI, int* NSHR, int* NTENS,
          int* NSTATV, double* PROPS, int* NPROPS, double* COORDS, double* DROT, double* PNEWDT, double* CELENT,
          double* DFGRD0, double* DFGRD1, int* NOEL, int* NPT, int* LAYER, int* KSPT, int* KSTEP, int* KINC) {
  static int calls = 0;
  double E = 1e4;
#ifdef COUNTS /* but the answer does not depend on it */
  ++calls;
#endif
#ifdef TIRES
  E -= 1e-3 * ++calls;
#endif
#ifdef UNSTABLE
  E = -E;
#endif
#ifdef NO_NUMBER
  E = nan("");
#endif
#ifdef NEEDS_PRESSURE
  if (STRESS[1] >= 0) xit_();
#endif
#ifdef CALLS_NOBODY
  is_nowhere_();
#endif
#ifdef LEAVES_AT_ONCE
  xit_();
#endif
  double largest = 0;
  for (int i = 0; i < *NTENS; ++i) largest = fmax(largest, fabs(STRAN[i] + DSTRAN[i]));
#ifdef LEAVES /* beyond what it is probed with */
  if (largest > 0.02) xit_();
#endif
#ifdef WRITES_PROPS
  PROPS[0] += 1;
#endif
#ifdef SHORTENS /* its increments are at most this large */
  for (int i = 0; i < *NTENS; ++i)
    if (fabs(DSTRAN[i]) > 2e-4) *PNEWDT = 0.5;
#endif
#ifdef VISCOUS
  E *= 1 + 1 / (1 + *DTIME);
#endif
  const int n = *NTENS;
  for (int i = 0; i < n; ++i) DDSDDE[i + n * i] = i < *NDI ? E : E / 2;
  for (int i = 0; i < n; ++i) STRESS[i] += DDSDDE[i + n * i] * DSTRAN[i];
  (void)calls;
}
