// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/challenged.cpp"
