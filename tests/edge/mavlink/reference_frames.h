// SPDX-License-Identifier: MIT
#pragma once

// Frames made by another implementation: node-mavlink 2.3.0 (npm), from the values in the comments.
// System 1; the autopilot is component 1, the companion 191.
namespace plumbline::mavlink::reference {

// HEARTBEAT: type 2, autopilot 3, base_mode 209, custom_mode 4, system_status 4, mavlink_version 3.
inline constexpr const char* kHeartbeat = "fd090000c80101000000040000000203d10403c661";
inline constexpr const char* kHeartbeatV1 = "fe090a010100040000000203d104033852";
// The same with a signature: link 5, a secret key of 32 bytes 7.
inline constexpr const char* kHeartbeatSigned =
    "fd0901004d0101000000040000000203d10403461b0520a2b0701d22912873c714c1";

// ATTITUDE: time_boot_ms 123456, roll 0.0125, pitch -0.05, yaw 1.5, rollspeed 0.001, pitchspeed
// -0.002, yawspeed 0.25.
inline constexpr const char* kAttitude =
    "fd1c0000c901011e000040e20100cdcc4c3ccdcc4cbd0000c03f6f12833a6f1203bb0000803eeff8";
inline constexpr const char* kAttitudeV1 =
    "fe1c0b01011e40e20100cdcc4c3ccdcc4cbd0000c03f6f12833a6f1203bb0000803e9428";

// GLOBAL_POSITION_INT: time_boot_ms 123460, lat 356687390, lon 1397610904, alt 52140, relative_alt
// -310, vx -12, vy 34, vz -300, hdg 35999.
inline constexpr const char* kPosition =
    "fd1c0000ca010121000044e201001e9e421598d94d53accb0000cafefffff4ff2200d4fe9f8cb156";
inline constexpr const char* kPositionV1 =
    "fe1c0c01012144e201001e9e421598d94d53accb0000cafefffff4ff2200d4fe9f8c3aa9";
// time_boot_ms 7, lat -338567844, lon -1512152970, all else 0: sixteen zeros are left out.
inline constexpr const char* kPositionCut = "fd0c0000cb0101210000070000005cddd1eb7660dea5ed0c";

// SYSTEM_TIME, which is not read here: time_unix_usec 1795168800200000, time_boot_ms 123470.
inline constexpr const char* kSystemTime = "fd0b000003010102000040d5a54eb26006004ee2016c36";

// What a companion sends, sequence 0: HEARTBEAT of type 18, autopilot 8, system_status 4.
inline constexpr const char* kOwnHeartbeat = "fd0900000001bf000000000000001208000403aec6";
inline constexpr const char* kOwnHeartbeatV1 = "fe090001bf00000000001208000403058c";
// Sequence 1: STATUSTEXT of severity 6, "height 2.1 cm: land".
inline constexpr const char* kOwnText =
    "fd1400000101bffd00000668656967687420322e3120636d3a206c616e6441ee";
// The same in MAVLink 1: with the extension fields, which the protocol's guide leaves out there.
inline constexpr const char* kOwnTextV1 =
    "fe360101bffd0668656967687420322e3120636d3a206c616e640000000000000000000000000000000000000000"
    "0000000000000000000000000000b23c";

}  // namespace plumbline::mavlink::reference
