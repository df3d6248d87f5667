// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// As much of HDAPI as the adapter uses, in declarations of our own. interface_open_haptics.cpp compares them
// with the real header where there is one.

using HDuint = unsigned int;
using HDboolean = unsigned char;
using HDushort = unsigned short;
using HDint = int;
using HDdouble = double;
using HDerror = unsigned int;
using HDenum = unsigned int;
using HDstring = const char*;
using HHD = unsigned int;
using HDCallbackCode = unsigned int;
using HDSchedulerHandle = unsigned long;
struct HDErrorInfo {
  HDerror errorCode;
  int internalErrorCode;
  HHD hHD;
};

#define HDAPIENTRY
#define HDCALLBACK
using HDSchedulerCallback = HDCallbackCode(HDCALLBACK*)(void*);

#define HD_DEVICE_ERROR(X) (((X).errorCode) != HD_SUCCESS)
#define HD_DEFAULT_DEVICE nullptr
#define HD_INVALID_HANDLE 0xFFFFFFFF
#define HD_SUCCESS 0x0000
#define HD_BAD_HANDLE 0x0104
#define HD_EXCEEDED_MAX_FORCE 0x0201
#define HD_DEVICE_FAULT 0x0300
#define HD_DEVICE_ALREADY_INITIATED 0x0301
#define HD_COMM_ERROR 0x0302
#define HD_COMM_CONFIG_ERROR 0x0303
#define HD_SCHEDULER_FULL 0x0501
#define HD_CURRENT_POSITION 0x2050
#define HD_CURRENT_TRANSFORM 0x2052
#define HD_DEVICE_MODEL_TYPE 0x2501
#define HD_UPDATE_RATE 0x2600
#define HD_INSTANTANEOUS_UPDATE_RATE 0x2601
#define HD_NOMINAL_MAX_STIFFNESS 0x2602
#define HD_NOMINAL_MAX_FORCE 0x2603
#define HD_NOMINAL_MAX_CONTINUOUS_FORCE 0x2604
#define HD_CURRENT_FORCE 0x2700
#define HD_FORCE_OUTPUT 0x4000
#define HD_MAX_FORCE_CLAMPING 0x4001
#define HD_DEFAULT_SCHEDULER_PRIORITY 32767
#define HD_CALLBACK_DONE 0
#define HD_CALLBACK_CONTINUE 1

extern "C" {
HHD HDAPIENTRY hdInitDevice(HDstring name);
void HDAPIENTRY hdMakeCurrentDevice(HHD device);
void HDAPIENTRY hdDisableDevice(HHD device);
void HDAPIENTRY hdBeginFrame(HHD device);
void HDAPIENTRY hdEndFrame(HHD device);
HDErrorInfo HDAPIENTRY hdGetError();
void HDAPIENTRY hdEnable(HDenum what);
HDboolean HDAPIENTRY hdIsEnabled(HDenum what);
void HDAPIENTRY hdGetIntegerv(HDenum what, HDint* values);
void HDAPIENTRY hdGetDoublev(HDenum what, HDdouble* values);
HDstring HDAPIENTRY hdGetString(HDenum what);
void HDAPIENTRY hdSetDoublev(HDenum what, const HDdouble* values);
HDSchedulerHandle HDAPIENTRY hdScheduleAsynchronous(HDSchedulerCallback call, void* user,
                                                    HDushort priority);
void HDAPIENTRY hdUnschedule(HDSchedulerHandle callback);
void HDAPIENTRY hdStartScheduler();
void HDAPIENTRY hdStopScheduler();
}
