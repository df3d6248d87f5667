// SPDX-License-Identifier: BSD-3-Clause
// What .ci/run compiles, with reference.hpp precompiled, to know how fast its machine is: it takes what a test takes,
// also of the kernel, and as long whatever the library does.
template <class Matrix>
double taken_apart(const Matrix& a) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(a);
  return double(eigen.eigenvalues()(0) + a.determinant());
}

double reference() {
  return taken_apart(Eigen::Matrix3d(Eigen::Matrix3d::Random())) +
         taken_apart(Eigen::Matrix3f(Eigen::Matrix3f::Random())) +
         taken_apart(Eigen::Matrix<long double, 3, 3>(Eigen::Matrix<long double, 3, 3>::Random()));
}
