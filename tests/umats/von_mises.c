/* The routine of von_mises.f in C: arrays are stored column by column, and what is not used has no type here. */
#include <math.h>
#include <stddef.h>

void umat_(double* STRESS, double* STATEV, double* DDSDDE, double* SSE, double* SPD, double* SCD, double* RPL,
           double* DDSDDT, double* DRPLDE, double* DRPLDT, double* STRAN, double* DSTRAN, double* TIME, double* DTIME,
           double* TEMP, double* DTEMP, double* PREDEF, double* DPRED, char* CMNAME, int* NDI, int* NSHR, int* NTENS,
           int* NSTATV, double* PROPS, int* NPROPS, double* COORDS, double* DROT, double* PNEWDT, double* CELENT,
           double* DFGRD0, double* DFGRD1, int* NOEL, int* NPT, int* LAYER, int* KSPT, int* KSTEP, int* KINC) {
  const double E = PROPS[0], nu = PROPS[1], k = PROPS[2];
  const double G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));
  const int n = *NTENS, normals = *NDI;
  const double tr = DSTRAN[0] + DSTRAN[1] + DSTRAN[2];
  for (int i = 0; i < n; ++i)
    STRESS[i] += i < normals ? K * tr + 2 * G * (DSTRAN[i] - tr / 3) : G * DSTRAN[i];

  const double p = (STRESS[0] + STRESS[1] + STRESS[2]) / 3;
  double s[6], J2 = 0;
  for (int i = 0; i < n; ++i) {
    s[i] = i < normals ? STRESS[i] - p : STRESS[i];
    J2 += (i < normals ? 0.5 : 1.0) * s[i] * s[i];
  }
  const double root_J2 = sqrt(J2);
  double scale = 1, change = 0;
  if (root_J2 > k) {
    scale = k / root_J2;
    change = -G * k / (root_J2 * J2);
    STATEV[0] += (root_J2 - k) / G;
  }
  for (int i = 0; i < n; ++i) STRESS[i] = scale * s[i] + (i < normals ? p : 0);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      double C = change * s[i] * s[j];
      if (i < normals && j < normals) C += K - 2 * G * scale / 3;
      if (i == j) C += (i < normals ? 2 : 1) * G * scale;
      DDSDDE[i + n * j] = C;
    }
  }
}
