# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# The installed system: a Debian with systemd and the packages of build/release/deb, in a machine
# whose disk loses unflushed writes with its power. Sourced; see tests/hil/README.md.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"

hil_system_folder=$hil_build/system
hil_memory=1536  # megabytes
hil_shell=no     # yes: a root shell on the socket "shell"

# What the disk is made of: the files of the packages, not when they were packed.
hil_system_stamp() {
  local deb
  {
    for deb in "$hil_release"/deb/*.deb; do dpkg-deb --ctrl-tarfile "$deb" | tar --extract --to-stdout; done
    echo "$hil_version" "${hil_test_drivers[*]}"
    cat "$hil_source"/tests/hil/guest/{lib.sh,make_system} "$hil_source"/tests/hil/guest/system/* \
      "$hil_release/tests/hil/bench_lines"
  } | sha256sum
}

# Makes the disk and the initrd where they are missing or old. Status 3: a Debian cannot be had.
hil_system() {
  local as_root=() stamp
  if ! ls "$hil_release"/deb/*.deb >/dev/null 2>&1; then
    echo "hil_system: no packages in $hil_release/deb; run scripts/packages" >&2
    return 1
  fi
  stamp=$(hil_system_stamp)
  [ "$(cat "$hil_system_folder/stamp" 2>/dev/null || true)" = "$stamp" ] && return
  mkdir -p "$hil_system_folder"
  rm -f "$hil_system_folder/stamp"
  hil_kernel >/dev/null || return
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  "${as_root[@]}" "$hil_source/tests/hil/guest/make_system" || return
  echo "$stamp" >"$hil_system_folder/stamp"
}

# hil_await SECONDS COMMAND...: until it succeeds.
hil_await() {
  local deadline=$((SECONDS + $1))
  shift
  until "$@"; do
    [ $SECONDS -lt $deadline ] || { echo "hil: not within its time: $*" >&2; return 1; }
    sleep 0.05
  done
}

# hil_is_gone PIDFILE
hil_is_gone() {
  [ ! -s "$1" ] || ! kill -0 "$(cat "$1")" 2>/dev/null
}

# The disk's server. It writes to the disk what it was told to flush, and only that. What it has
# written outlives it without being synced, for which the guest would wait on a busy machine.
hil_start_disk() {
  local work=$1
  [ -e "$work/disk" ] || cp --sparse=always "$hil_system_folder/disk" "$work/disk"
  # In the background: in the foreground it would end with the shell that started it.
  eatmydata nbdkit --unix "$hil_sockets/nbd" --pidfile "$work/nbd.pid" \
    --filter=cache file "$work/disk" cache=writeback </dev/null >"$work/nbd.log" 2>&1 ||
    { cat "$work/nbd.log" >&2; return 1; }
}

# hil_socket NAME: arguments for QEMU, a character device whose other end may come and go.
hil_socket() {
  echo "-chardev socket,id=$1,path=$hil_sockets/$1,server=on,wait=off"
}

hil_qemu() {
  local work=$1 shell=''
  shift
  if [ "$hil_shell" = yes ]; then
    shell="$(hil_socket shell) -serial chardev:shell"
    hil_append+=' systemd.wants=serial-getty@ttyS1.service'
  fi
  # shellcheck disable=SC2046,SC2086 # arguments, many
  exec qemu-system-x86_64 \
    -accel tcg,thread=multi -cpu "$hil_cpu" -machine pc -smp 2 -m "$hil_memory" \
    -nodefaults -no-user-config -display none -no-reboot -pidfile "$work/qemu.pid" \
    -kernel "$(hil_kernel)/boot/vmlinuz-$hil_version" -initrd "$hil_system_folder/initrd" \
    -append "$hil_kernel_words systemd.show_status=error fsck.repair=yes $hil_append" \
    -serial "file:$work/kernel.log" $shell \
    -drive "file=nbd:unix:$hil_sockets/nbd,format=raw,if=virtio,cache=writeback" \
    -device qemu-xhci,id=xhci -device virtio-rng-pci -device virtio-serial-pci \
    $(hil_socket gnss) -device usb-serial,id=gnss,chardev=gnss,bus=xhci.0 \
    $(hil_socket camera) -device usb-redir,id=camera,chardev=camera,bus=xhci.0 \
    $(hil_socket qmp) -mon chardev=qmp,mode=control \
    $(hil_socket orders) -device virtserialport,chardev=orders,name=orders \
    $(hil_socket status) -device virtserialport,chardev=status,name=status \
    $(hil_socket lines) -device virtserialport,chardev=lines,name=lines \
    -chardev "file,id=files,path=$work/files.tar" -device virtserialport,chardev=files,name=files \
    "$@"
}

# hil_start_system WORK [QEMU ARGUMENT...]: power on. The disk is WORK/disk, a new one where there is
# none. Leaves in hil_sockets the folder of the sockets gnss, camera, qmp, orders, status and lines, in
# WORK/sockets a link to it, and in WORK the kernel's console and what the guest hands out. Returns
# when the sockets are there. USB devices are plugged in while a program holds their socket.
hil_start_system() {
  local work=$1
  shift
  mkdir -p "$work"
  rm -f "$work"/{qemu,nbd}.pid "$work/files.tar"
  hil_sockets=$(mktemp --directory --tmpdir plumbline-hil-XXXXXX)
  ln -sfn "$hil_sockets" "$work/sockets"
  hil_start_disk "$work"
  (hil_qemu "$work" "$@") </dev/null >"$work/qemu.log" 2>&1 &
  disown
  hil_await 10 [ -s "$work/qemu.pid" ] || { cat "$work/qemu.log" >&2; return 1; }
  # QEMU says that it runs before it has made them all.
  local name
  for name in gnss camera qmp orders status lines; do hil_await 30 [ -S "$hil_sockets/$name" ]; done
}

# hil_kill SIGNAL PIDFILE: returns when it is gone.
hil_kill() {
  [ ! -s "$2" ] || kill "-$1" "$(cat "$2")" 2>/dev/null || true
  hil_await 10 hil_is_gone "$2"
  rm -f "$2"
}

hil_forget_sockets() {
  [ ! -L "$1/sockets" ] || rm -rf "$(readlink "$1/sockets")" "$1/sockets"
}

# hil_cut_power WORK: takes what the kernel had not written, and with the disk's server what the disk
# had not been told to flush. Nothing happens where the power is off.
hil_cut_power() {
  hil_kill KILL "$1/qemu.pid"
  hil_kill KILL "$1/nbd.pid"
  hil_forget_sockets "$1"
}

# hil_end_system WORK SECONDS: waits for a guest that was told to power off. Fails where it had to be
# killed.
hil_end_system() {
  local work=$1 seconds=$2 status=0
  if ! hil_await "$seconds" hil_is_gone "$work/qemu.pid" 2>/dev/null; then
    echo "hil: the guest did not power off within $seconds s, and was killed" >&2
    hil_kill KILL "$work/qemu.pid"
    status=1
  fi
  rm -f "$work/qemu.pid"
  hil_kill TERM "$work/nbd.pid" || { hil_kill KILL "$work/nbd.pid"; status=1; }
  hil_forget_sockets "$work"
  return $status
}

# hil_connect_orders SECONDS: connects to the shell of the guest, for hil_order, and waits until it
# answers, that is, until the guest is up. One at a time.
hil_connect_orders() {
  local line word=connected-$RANDOM$RANDOM
  coproc hil_socat { exec socat - "UNIX-CONNECT:$hil_sockets/orders" 2>/dev/null; }
  # Copies: those of the coprocess are not for subshells.
  exec {hil_from_guest}<&"${hil_socat[0]}" {hil_to_guest}>&"${hil_socat[1]}"
  # Whatever comes before is an answer to another.
  printf 'echo %s\n' "$word" >&"$hil_to_guest"
  while IFS= read -r -t "$1" line <&"$hil_from_guest"; do
    if [ "$line" = "$word" ]; then read -r -t "$1" <&"$hil_from_guest" && return; fi
  done
  echo "hil: the guest does not answer within $1 s" >&2
  return 1
}

hil_disconnect_orders() {
  local pid=${hil_socat_PID:-}
  exec {hil_from_guest}<&- {hil_to_guest}>&-
  [ -z "$pid" ] || kill "$pid" 2>/dev/null || true
  [ -z "$pid" ] || wait "$pid" 2>/dev/null || true
}

# hil_order SECONDS COMMAND: runs it in the guest as root; what it prints, and its exit status. 124:
# no answer in time; nothing that comes later can be trusted then.
hil_order() {
  local deadline=$((SECONDS + $1)) line left
  printf '%s\n' "$2" >&"$hil_to_guest"
  while left=$((deadline - SECONDS)) && [ $left -gt 0 ] && IFS= read -r -t "$left" line <&"$hil_from_guest"; do
    case "$line" in '=== '*) return "${line#=== }" ;; esac
    printf '%s\n' "$line"
  done
  echo "hil: no answer from the guest within $1 s: $2" >&2
  return 124
}
