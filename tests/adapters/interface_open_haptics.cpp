// SPDX-License-Identifier: BSD-3-Clause
// What the adapter takes for granted of HDAPI. Compiled against our own declarations always, and
// against the vendor's where -DPASSIVE_HAPTICS_OPEN_HAPTICS=<its include folder> says where they
// are.
#include <HD/hd.h>
#include <cstddef>
#include <type_traits>

template <class Expected, class Found>
constexpr bool same = std::is_same_v<Expected, Found>;

static_assert(same<HHD (*)(HDstring), decltype(&hdInitDevice)>);
static_assert(same<void (*)(HHD), decltype(&hdMakeCurrentDevice)>);
static_assert(same<void (*)(HHD), decltype(&hdDisableDevice)>);
static_assert(same<void (*)(HHD), decltype(&hdBeginFrame)>);
static_assert(same<void (*)(HHD), decltype(&hdEndFrame)>);
static_assert(same<HDErrorInfo (*)(), decltype(&hdGetError)>);
static_assert(same<void (*)(HDenum), decltype(&hdEnable)>);
static_assert(same<HDboolean (*)(HDenum), decltype(&hdIsEnabled)> &&
              same<unsigned char, HDboolean>);
static_assert(same<void (*)(HDenum, HDint*), decltype(&hdGetIntegerv)>);
static_assert(same<void (*)(HDenum, HDdouble*), decltype(&hdGetDoublev)>);
static_assert(same<HDstring (*)(HDenum), decltype(&hdGetString)>);
static_assert(same<void (*)(HDenum, const HDdouble*), decltype(&hdSetDoublev)>);
static_assert(same<HDSchedulerHandle (*)(HDSchedulerCallback, void*, HDushort),
                   decltype(&hdScheduleAsynchronous)>);
static_assert(same<void (*)(HDSchedulerHandle), decltype(&hdUnschedule)>);
static_assert(same<HDCallbackCode (*)(void*), HDSchedulerCallback>);
static_assert(same<HDerror, decltype(HDErrorInfo::errorCode)>);
static_assert(same<unsigned int, HDerror> && same<unsigned int, HDenum> && same<unsigned int, HHD>);
static_assert(same<double, HDdouble> && same<int, HDint> && same<const char*, HDstring>);

static_assert(HD_SUCCESS == 0 && HD_CALLBACK_DONE == 0 && HD_CALLBACK_CONTINUE == 1);
static_assert(HD_BAD_HANDLE == 0x0104 && HD_DEVICE_FAULT == 0x0300 && HD_COMM_ERROR == 0x0302);
static_assert(HD_COMM_CONFIG_ERROR == 0x0303 && HD_DEVICE_ALREADY_INITIATED == 0x0301);
static_assert(HD_EXCEEDED_MAX_FORCE == 0x0201 && HD_SCHEDULER_FULL == 0x0501);
static_assert(HD_CURRENT_POSITION == 0x2050 && HD_CURRENT_TRANSFORM == 0x2052);
static_assert(HD_CURRENT_FORCE == 0x2700 && HD_INSTANTANEOUS_UPDATE_RATE == 0x2601);
static_assert(HD_UPDATE_RATE == 0x2600 && HD_NOMINAL_MAX_STIFFNESS == 0x2602);
static_assert(HD_NOMINAL_MAX_FORCE == 0x2603 && HD_NOMINAL_MAX_CONTINUOUS_FORCE == 0x2604);
static_assert(HD_DEVICE_MODEL_TYPE == 0x2501 && HD_FORCE_OUTPUT == 0x4000);
static_assert(HD_MAX_FORCE_CLAMPING == 0x4001 && HD_INVALID_HANDLE == 0xFFFFFFFF);

[[maybe_unused]] constexpr HDSchedulerCallback takes = [](void*) -> HDCallbackCode {
  const HDErrorInfo error{};
  return HD_DEVICE_ERROR(error) || HD_DEFAULT_DEVICE != nullptr ? HD_CALLBACK_DONE
                                                                : HD_CALLBACK_CONTINUE;
};
static_assert(HD_DEFAULT_SCHEDULER_PRIORITY > 0);
