// SPDX-License-Identifier: BSD-3-Clause
// What .ci/run compiles to know how fast its machine is: Eigen alone, nothing of ours, so that it takes as
// long whatever the library does.
#include <Eigen/Dense>

template <class Matrix>
double taken_apart(const Matrix& a) {
  const Eigen::JacobiSVD<Matrix> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(a);
  return double(svd.singularValues()(0) + eigen.eigenvalues()(0) + a.fullPivLu().determinant());
}

double reference() {
  return taken_apart(Eigen::Matrix3d(Eigen::Matrix3d::Random())) +
         taken_apart(Eigen::Matrix<float, 6, 6>(Eigen::Matrix<float, 6, 6>::Random())) +
         taken_apart(Eigen::MatrixXd(Eigen::MatrixXd::Random(7, 7)));
}
