// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// As much of DHD as the adapter uses, in declarations of our own. interface_force_dimension.cpp compares them
// with the real header where there is one.

using uchar = unsigned char;
#define DHD_ON 1
#define DHD_MAX_DOF 8
#define DHD_TIMEGUARD 1
#define DHD_MOTOR_SATURATED 2
#define DHD_MAX_STATUS 16
#define DHD_STATUS_FORCE 5

extern "C" {
int dhdErrorGetLast();
int dhdOpen();
int dhdOpenID(char id);
int dhdClose(char id = -1);
int dhdEnableForce(uchar on, char id = -1);
int dhdGetStatus(int status[DHD_MAX_STATUS], char id = -1);
const char* dhdGetSystemName(char id = -1);
bool dhdHasActiveWrist(char id = -1);
int dhdGetPosition(double* x, double* y, double* z, char id = -1);
int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double rows[3][3],
                                      char id = -1);
double dhdGetComFreq(char id = -1);
int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx, double ty,
                                        double tz, double g, char id = -1);
int dhdGetForceAndTorqueAndGripperForce(double* fx, double* fy, double* fz, double* tx, double* ty,
                                        double* tz, double* g, char id = -1);
int dhdEnableExpertMode();
int dhdDisableExpertMode();
int dhdGetJointAngles(double angles[DHD_MAX_DOF], char id = -1);
int dhdJointAnglesToInertiaMatrix(double angles[DHD_MAX_DOF], double inertia[6][6], char id = -1);
double dhdGetMaxForce(char id = -1);
double dhdGetTime();
}
