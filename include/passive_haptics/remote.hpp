// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An environment on another machine, which sends the touched surface, while the local model runs at the
// device. The menu:
//
//   remote/wire.hpp         the datagram: 152 bytes, little-endian, versioned, checked; encode, decode
//   remote/content.hpp      plane, quadric and probe to numbers and back
//   remote/session.hpp      the common part of both ends: two random numbers, order, counts
//   remote/siphash.hpp      SipHash-2-4, a keyed hash
//   remote/seal.hpp         authenticates every datagram, if both ends share a key
//   remote/client.hpp       the device's end: sends requests and keeps the last good answer
//   remote/server.hpp       the environment's end: answers requests, of one client at a time
//   remote/udp_socket.hpp   carries the bytes on POSIX systems
//
//   device ─▶ local model ─▶ force      1 kHz, here: passive for any network delay and loss
//      │           ▲
//      │ position  │ surface, delayed by the network
//      ▼           │
//   client ◀──── UDP ────▶ server ◀──▶ environment      50 to 200 Hz
//
// The hand is protected and the environment is not: nothing limits the energy that the environment gives out for a
// position that comes late or never. To protect it, too (a robot, a second hand), a two-port has to cross the
// network, with a ledger at both ends: two_port.hpp, in sessions of this room. docs/remote.md has the format, the
// guarantees and their limits, and the cost of both.

#include <passive_haptics/remote/client.hpp>
#include <passive_haptics/remote/content.hpp>
#include <passive_haptics/remote/seal.hpp>
#include <passive_haptics/remote/server.hpp>
#include <passive_haptics/remote/session.hpp>
#include <passive_haptics/remote/siphash.hpp>
#include <passive_haptics/remote/udp_socket.hpp>
#include <passive_haptics/remote/wire.hpp>
