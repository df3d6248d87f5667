// SPDX-License-Identifier: BSD-3-Clause
// What .ci/reference.cpp reads: Eigen and the standard library, nothing of ours.
#include <Eigen/Dense>

#include <functional>
#include <iostream>
#include <map>
#include <random>
#include <regex>
#include <string>
#include <vector>
