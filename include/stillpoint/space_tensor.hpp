// Tensors in three dimensions, of numbers or of Duals.
#pragma once

namespace stillpoint {

template <class Number>
struct SpaceTensorOf {
  Number xx, xy, xz, yx, yy, yz, zx, zy, zz;
};
using SpaceTensor = SpaceTensorOf<double>;

template <class N>
constexpr SpaceTensorOf<N> operator+(const SpaceTensorOf<N>& A, const SpaceTensorOf<N>& B) {
  return {A.xx + B.xx, A.xy + B.xy, A.xz + B.xz, A.yx + B.yx, A.yy + B.yy,
          A.yz + B.yz, A.zx + B.zx, A.zy + B.zy, A.zz + B.zz};
}
template <class N>
constexpr SpaceTensorOf<N> operator-(const SpaceTensorOf<N>& A, const SpaceTensorOf<N>& B) {
  return {A.xx - B.xx, A.xy - B.xy, A.xz - B.xz, A.yx - B.yx, A.yy - B.yy,
          A.yz - B.yz, A.zx - B.zx, A.zy - B.zy, A.zz - B.zz};
}
template <class Scalar, class N>
constexpr SpaceTensorOf<N> operator*(const Scalar& a, const SpaceTensorOf<N>& A) {
  return {a * A.xx, a * A.xy, a * A.xz, a * A.yx, a * A.yy, a * A.yz, a * A.zx, a * A.zy, a * A.zz};
}
template <class N>
constexpr SpaceTensorOf<N> operator*(const SpaceTensorOf<N>& A, const SpaceTensorOf<N>& B) {
  return {A.xx * B.xx + A.xy * B.yx + A.xz * B.zx, A.xx * B.xy + A.xy * B.yy + A.xz * B.zy,
          A.xx * B.xz + A.xy * B.yz + A.xz * B.zz, A.yx * B.xx + A.yy * B.yx + A.yz * B.zx,
          A.yx * B.xy + A.yy * B.yy + A.yz * B.zy, A.yx * B.xz + A.yy * B.yz + A.yz * B.zz,
          A.zx * B.xx + A.zy * B.yx + A.zz * B.zx, A.zx * B.xy + A.zy * B.yy + A.zz * B.zy,
          A.zx * B.xz + A.zy * B.yz + A.zz * B.zz};
}
/// c I + A
template <class Scalar, class N>
constexpr SpaceTensorOf<N> sphere_plus(const Scalar& c, const SpaceTensorOf<N>& A) {
  return {c + A.xx, A.xy, A.xz, A.yx, c + A.yy, A.yz, A.zx, A.zy, c + A.zz};
}
/// I + A
template <class N>
constexpr SpaceTensorOf<N> unit_plus(const SpaceTensorOf<N>& A) {
  return sphere_plus(1.0, A);
}
template <class N>
constexpr SpaceTensorOf<N> transpose(const SpaceTensorOf<N>& A) {
  return {A.xx, A.yx, A.zx, A.xy, A.yy, A.zy, A.xz, A.yz, A.zz};
}
template <class N>
constexpr N trace(const SpaceTensorOf<N>& A) {
  return A.xx + A.yy + A.zz;
}
/// The product A S Aᵀ for a symmetric S, which is symmetric too.
template <class N>
constexpr SpaceTensorOf<N> turned(const SpaceTensorOf<N>& A, const SpaceTensorOf<N>& S) {
  const SpaceTensorOf<N> B = A * S;
  const N xy = B.xx * A.yx + B.xy * A.yy + B.xz * A.yz, yz = B.yx * A.zx + B.yy * A.zy + B.yz * A.zz,
          zx = B.zx * A.xx + B.zy * A.xy + B.zz * A.xz;
  return {B.xx * A.xx + B.xy * A.xy + B.xz * A.xz, xy, zx, xy, B.yx * A.yx + B.yy * A.yy + B.yz * A.yz, yz, zx, yz,
          B.zx * A.zx + B.zy * A.zy + B.zz * A.zz};
}
/// The same for a rotation R and a deviator S, which stays one: 35 products instead of 45.
template <class N>
constexpr SpaceTensorOf<N> turned_deviator(const SpaceTensorOf<N>& R, const SpaceTensorOf<N>& S) {
  const N Bxx = R.xx * S.xx + R.xy * S.xy + R.xz * S.zx, Bxy = R.xx * S.xy + R.xy * S.yy + R.xz * S.yz,
          Bxz = R.xx * S.zx + R.xy * S.yz + R.xz * S.zz, Byx = R.yx * S.xx + R.yy * S.xy + R.yz * S.zx,
          Byy = R.yx * S.xy + R.yy * S.yy + R.yz * S.yz, Byz = R.yx * S.zx + R.yy * S.yz + R.yz * S.zz;
  const N xx = Bxx * R.xx + Bxy * R.xy + Bxz * R.xz, yy = Byx * R.yx + Byy * R.yy + Byz * R.yz,
          xy = Bxx * R.yx + Bxy * R.yy + Bxz * R.yz, yz = Byx * R.zx + Byy * R.zy + Byz * R.zz,
          zx = Bxx * R.zx + Bxy * R.zy + Bxz * R.zz;
  return {xx, xy, zx, xy, yy, yz, zx, yz, -(xx + yy)};
}
/// The product of symmetric tensors that commute, as functions of one tensor do, which is symmetric too.
template <class N>
constexpr SpaceTensorOf<N> symmetric_product(const SpaceTensorOf<N>& A, const SpaceTensorOf<N>& B) {
  const N xy = A.xx * B.xy + A.xy * B.yy + A.zx * B.yz, yz = A.xy * B.zx + A.yy * B.yz + A.yz * B.zz,
          zx = A.xx * B.zx + A.xy * B.yz + A.zx * B.zz;
  return {A.xx * B.xx + A.xy * B.xy + A.zx * B.zx, xy, zx, xy, A.xy * B.xy + A.yy * B.yy + A.yz * B.yz, yz, zx, yz,
          A.zx * B.zx + A.yz * B.yz + A.zz * B.zz};
}
/// cof A = det A A⁻ᵀ
template <class N>
constexpr SpaceTensorOf<N> cofactor(const SpaceTensorOf<N>& A) {
  return {A.yy * A.zz - A.yz * A.zy, A.yz * A.zx - A.yx * A.zz, A.yx * A.zy - A.yy * A.zx,
          A.xz * A.zy - A.xy * A.zz, A.xx * A.zz - A.xz * A.zx, A.xy * A.zx - A.xx * A.zy,
          A.xy * A.yz - A.xz * A.yy, A.xz * A.yx - A.xx * A.yz, A.xx * A.yy - A.xy * A.yx};
}
template <class N>
constexpr N determinant(const SpaceTensorOf<N>& A) {
  const SpaceTensorOf<N> c = cofactor(A);
  return A.xx * c.xx + A.xy * c.xy + A.xz * c.xz;
}
/// The relative change of volume det(I + H) − 1 = tr H + tr cof H + det H, with the digits of a small H.
template <class N>
constexpr N change_of_volume(const SpaceTensorOf<N>& H, const SpaceTensorOf<N>& cof_H) {
  return trace(H) + (trace(cof_H) + (H.xx * cof_H.xx + H.xy * cof_H.xy + H.xz * cof_H.xz));
}
template <class N>
constexpr N change_of_volume(const SpaceTensorOf<N>& H) {
  return change_of_volume(H, cofactor(H));
}
template <class N>
constexpr SpaceTensorOf<N> inverse(const SpaceTensorOf<N>& A) {
  const SpaceTensorOf<N> c = cofactor(A);
  return (1 / (A.xx * c.xx + A.xy * c.xy + A.xz * c.xz)) * transpose(c);
}
/// The inverse of a symmetric tensor.
template <class N>
constexpr SpaceTensorOf<N> symmetric_inverse(const SpaceTensorOf<N>& A) {
  const N xx = A.yy * A.zz - A.yz * A.yz, xy = A.yz * A.zx - A.xy * A.zz, zx = A.xy * A.yz - A.yy * A.zx,
          yz = A.xy * A.zx - A.xx * A.yz;
  return (1 / (A.xx * xx + A.xy * xy + A.zx * zx)) *
         SpaceTensorOf<N>{xx, xy, zx, xy, A.xx * A.zz - A.zx * A.zx, yz, zx, yz, A.xx * A.yy - A.xy * A.xy};
}

}  // namespace stillpoint
