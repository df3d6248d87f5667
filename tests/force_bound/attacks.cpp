// SPDX-License-Identifier: BSD-3-Clause
// The attacks on composed models, compiled once for the quick tests.
#include "force_bound/attacks.hpp"

namespace attacks {

template outcome worst_run(victim<d1>&, const conditions&, int);
template outcome worst_run(victim<d2>&, const conditions&, int);
template outcome worst_run(victim<d3>&, const conditions&, int);
template outcome worst_run(victim<f1>&, const conditions&, int);
template outcome worst_run(victim<f2>&, const conditions&, int);
template outcome worst_run(victim<f3>&, const conditions&, int);
template double tapping(victim<d1>&, int);
template fall falling(victim<d1>&);

}  // namespace attacks
