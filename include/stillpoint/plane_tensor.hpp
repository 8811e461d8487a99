// Tensors of plane and axisymmetric problems: the third direction (z, or the hoop θ) is a principal one.
#pragma once

namespace stillpoint {

struct PlaneTensor {
  double xx, xy, yx, yy, zz;
};

constexpr PlaneTensor operator+(const PlaneTensor& A, const PlaneTensor& B) {
  return {A.xx + B.xx, A.xy + B.xy, A.yx + B.yx, A.yy + B.yy, A.zz + B.zz};
}
constexpr PlaneTensor operator-(const PlaneTensor& A, const PlaneTensor& B) {
  return {A.xx - B.xx, A.xy - B.xy, A.yx - B.yx, A.yy - B.yy, A.zz - B.zz};
}
constexpr PlaneTensor operator*(double a, const PlaneTensor& A) {
  return {a * A.xx, a * A.xy, a * A.yx, a * A.yy, a * A.zz};
}
constexpr PlaneTensor operator*(const PlaneTensor& A, const PlaneTensor& B) {
  return {A.xx * B.xx + A.xy * B.yx, A.xx * B.xy + A.xy * B.yy, A.yx * B.xx + A.yy * B.yx, A.yx * B.xy + A.yy * B.yy,
          A.zz * B.zz};
}
/// I + A
constexpr PlaneTensor unit_plus(const PlaneTensor& A) { return {1 + A.xx, A.xy, A.yx, 1 + A.yy, 1 + A.zz}; }
constexpr PlaneTensor transpose(const PlaneTensor& A) { return {A.xx, A.yx, A.xy, A.yy, A.zz}; }
constexpr double trace(const PlaneTensor& A) { return A.xx + A.yy + A.zz; }
/// The determinant of the in-plane part, det₂ A.
constexpr double plane_determinant(const PlaneTensor& A) { return A.xx * A.yy - A.xy * A.yx; }
constexpr double determinant(const PlaneTensor& A) { return plane_determinant(A) * A.zz; }
/// The relative change of area det₂(I + H) − 1, with the digits of a small H.
constexpr double change_of_area(const PlaneTensor& H) { return H.xx + H.yy + plane_determinant(H); }
/// The relative change of volume det(I + H) − 1, likewise.
constexpr double change_of_volume(const PlaneTensor& H) {
  const double of_area = change_of_area(H);
  return of_area + (1 + of_area) * H.zz;
}
constexpr PlaneTensor inverse(const PlaneTensor& A) {
  const double r = 1 / plane_determinant(A);
  return {r * A.yy, -r * A.xy, -r * A.yx, r * A.xx, 1 / A.zz};
}

}  // namespace stillpoint
