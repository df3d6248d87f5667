// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The Novint Falcon adapter. HID means haptic interface device: the Falcon is no USB-HID-class
// device but a serial bridge with a motor controller behind it (falcon/ftdi.hpp). No firmware is
// included; docs/falcon.md says how to begin.
//
//     falcon::device<falcon::libusb_transport> grip{falcon::cautious_gain<double>};
//     open(), boot(image), home(), then once a tick:   sample = grip.exchange(force)
//
// Without libusb's header there is no libusb_transport, and all the rest.

#include <passive_haptics/falcon/device.hpp>
#include <passive_haptics/falcon/libusb_transport.hpp>
#include <passive_haptics/falcon/recording_file.hpp>
#include <passive_haptics/falcon/runner.hpp>
