// SPDX-License-Identifier: BSD-3-Clause
// What the adapter takes for granted of DHD. Compiled against our own declarations always, and
// against the vendor's where -DPASSIVE_HAPTICS_FORCE_DIMENSION=<its include folder> says where
// they are. dhdGetMaxForce is asked only where it is declared.
#include <cstddef>
#include <dhdc.h>
#include <type_traits>

template <class Expected, class Found>
constexpr bool same = std::is_same_v<Expected, Found>;

static_assert(same<int (*)(), decltype(&dhdErrorGetLast)>);
static_assert(same<int (*)(), decltype(&dhdOpen)>);
static_assert(same<int (*)(char), decltype(&dhdOpenID)>);
static_assert(same<int (*)(char), decltype(&dhdClose)>);
static_assert(same<int (*)(unsigned char, char), decltype(&dhdEnableForce)>);
static_assert(same<int (*)(int*, char), decltype(&dhdGetStatus)>);
static_assert(same<const char* (*)(char), decltype(&dhdGetSystemName)>);
static_assert(same<bool (*)(char), decltype(&dhdHasActiveWrist)>);
static_assert(same<int (*)(double*, double*, double*, char), decltype(&dhdGetPosition)>);
static_assert(same<int (*)(double*, double*, double*, double (*)[3], char),
                   decltype(&dhdGetPositionAndOrientationFrame)>);
static_assert(same<double (*)(char), decltype(&dhdGetComFreq)>);
static_assert(same<int (*)(double, double, double, double, double, double, double, char),
                   decltype(&dhdSetForceAndTorqueAndGripperForce)>);
static_assert(same<int (*)(double*, double*, double*, double*, double*, double*, double*, char),
                   decltype(&dhdGetForceAndTorqueAndGripperForce)>);
static_assert(same<int (*)(), decltype(&dhdEnableExpertMode)>);
static_assert(same<int (*)(), decltype(&dhdDisableExpertMode)>);
static_assert(same<int (*)(double*, char), decltype(&dhdGetJointAngles)>);
static_assert(
    same<int (*)(double*, double (*)[6], char), decltype(&dhdJointAnglesToInertiaMatrix)>);
static_assert(same<double (*)(), decltype(&dhdGetTime)>);
static_assert(DHD_ON == 1 && DHD_MAX_DOF >= 6 && DHD_TIMEGUARD == 1 && DHD_MOTOR_SATURATED == 2);
static_assert(DHD_STATUS_FORCE >= 0 && DHD_STATUS_FORCE < DHD_MAX_STATUS);
