# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2154
# What flies in the virtual companion computer: for the scripts beside it. Who sources it sets `name`,
# of the folder of machine and recordings in build/hil, and `flying`, the options of bench_drone.
. "$(dirname "${BASH_SOURCE[0]}")/guest/system.sh"

work=$hil_build/$name
drone=$hil_release/tests/hil/bench_drone
plumbline=$hil_release/plumbline
failed=0
begin=$SECONDS
# On this host, where the power goes off and on.
power_off_and_on="bash -c '. $hil_source/tests/hil/guest/system.sh; hil_cut_power $work; hil_start_system $work'"

step() { printf '%7d s   %s\n' $((SECONDS - begin)) "$*"; }
fail() { echo "FAILED: $*"; failed=1; }
drone() { "$drone" --work "$work" --sockets "$work/sockets" "${flying[@]}" "$@"; }
fly() { drone fly --cut-power "$power_off_and_on" "$@"; }

# flown KEY: a figure of the last flight.
flown() { sed -n "s/.*\"$1\": \"\{0,1\}\([^\",]*\).*/\1/p" "$work/flown.json" 2>/dev/null || true; }

# A new machine in $work, switched on.
switch_on() {
  rm -rf "$work"
  mkdir -p "$work"
  hil_system
  begin=$SECONDS
  hil_start_system "$work"
  step "power on"
}

# In good order; sets `failed` where it had to be killed.
switch_off() {
  hil_order 20 'systemctl poweroff' || true
  hil_disconnect_orders
  hil_end_system "$work" 60 || failed=1
  step "power off"
}

# take FOLDER NAME: what the guest hands out, appended to what it handed out before.
take() {
  hil_order 120 "tar -C $1 -cf /dev/virtio-ports/files $2" && sleep 1 && tar -xif "$work/files.tar" -C "$work"
}

# Brings the recording of the last flight here, into the folder `recording`. Connects to the shell of
# the guest.
take_recording() {
  flight=$(flown flight)
  recording=$work/$flight
  hil_sockets=$(readlink "$work/sockets")
  hil_connect_orders 60
  take /var/lib/plumbline/flights "$flight"
  photos=$(find "$recording" -path '*/photos/*.jpg' | wc -l)
}

# Whole, with every photo that was said to be stored when the power was cut, if it was.
recording_is_whole() {
  local number said
  "$plumbline" check "$recording" || fail "the recording is not whole"
  said=$(flown stored_at_cut)
  for ((number = 1; number <= said; ++number)); do
    [ -e "$recording/photos/$(printf %04d $number).jpg" ] ||
      fail "photo $number is gone, of $said that were said to be stored when the power was cut"
  done
}
