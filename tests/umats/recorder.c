/* Writes what it is given into STATEV, and is else Hooke's law of E = 1e4, nu = 0. */
#include <stddef.h>

void umat_(double* STRESS, double* STATEV, double* DDSDDE, double* SSE, double* SPD, double* SCD, double* RPL,
           double* DDSDDT, double* DRPLDE, double* DRPLDT, double* STRAN, double* DSTRAN, double* TIME, double* DTIME,
           double* TEMP, double* DTEMP, double* PREDEF, double* DPRED, char* CMNAME, int* NDI, int* NSHR, int* NTENS,
           int* NSTATV, double* PROPS, int* NPROPS, double* COORDS, double* DROT, double* PNEWDT, double* CELENT,
           double* DFGRD0, double* DFGRD1, int* NOEL, int* NPT, int* LAYER, int* KSPT, int* KSTEP, int* KINC,
           size_t CMNAME_length) {
  const double E = 1e4;
  const int n = *NTENS;
  double* at = STATEV;
  for (int k = 0; k < 9; ++k) *at++ = DFGRD1[k];
  for (int k = 0; k < 9; ++k) *at++ = DFGRD0[k];
  for (int k = 0; k < 9; ++k) *at++ = DROT[k];
  for (int k = 0; k < 6; ++k) *at++ = k < n ? STRAN[k] + DSTRAN[k] : 0;
  for (int k = 0; k < 3; ++k) *at++ = COORDS[k];
  const double numbers[] = {TIME[0], TIME[1], *DTIME, *KINC, *CELENT, *NOEL, *NDI, *NSHR, *NTENS, *NSTATV, *NPROPS,
                            CMNAME[0], CMNAME[4], (double)CMNAME_length, *NPT, *LAYER, *KSPT, *KSTEP,
                            *TEMP + *DTEMP + *PREDEF + *DPRED + *SSE + *SPD + *SCD + *RPL, PROPS[0]};
  for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) *at++ = numbers[k];
  for (int k = 0; k < n; ++k) DDSDDE[k + n * k] = k < *NDI ? E : E / 2;
  for (int k = 0; k < n; ++k) STRESS[k] += DDSDDE[k + n * k] * DSTRAN[k];
}
