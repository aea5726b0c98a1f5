# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Makes and boots the virtual companion computer. Sourced by the cases; see tests/hil/README.md.
set -euo pipefail

hil_source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
hil_build=$hil_source/build/hil
hil_release=$hil_source/build/release

# What the next image holds.
hil_programs=()  # of this machine, with the shared libraries they need
hil_files=()     # HOST_PATH:GUEST_PATH
hil_modules=()   # loaded in this order, "name parameter=value"
hil_udev=no
hil_append=''  # of the next boot: more of the kernel's command line; "name=value" is in the environment

# The processor: what compilers of today take for granted, and libraries ask for.
hil_cpu=qemu64,+ssse3,+sse4.1,+sse4.2,+popcnt
# The kernel is to trust QEMU's clock, and to leave out what costs time there.
hil_kernel_words='console=ttyS0 loglevel=4 panic=-1 mitigations=off nokaslr no_timer_check tsc=reliable random.trust_cpu=on cryptomgr.notests'

# For the contract suite: a chip of gpio-sim, a line to put pulses out on and one to pull at.
# shellcheck disable=SC2034 # the cases use it
hil_gpio_chip='
bench=/sys/kernel/config/gpio-sim/bench
mkdir -p $bench/b0
echo 8 >$bench/b0/num_lines
mkdir $bench/b0/line4 $bench/b0/line5
echo SHUTTER >$bench/b0/line4/name
echo FLASH >$bench/b0/line5/name
echo 1 >$bench/live
chip=$(cat $bench/b0/chip_name)
export PLUMBLINE_TEST_GPIO_OUT=SHUTTER PLUMBLINE_TEST_GPIO_IN=$chip:5
export PLUMBLINE_TEST_GPIO_PULL=$(ls -d /sys/devices/platform/gpio-sim.*/gpiochip*/sim_gpio5)/pull
'

# The version of the newest stock kernel of this Debian.
hil_version() {
  [ -z "${hil_version:-}" ] || { echo "$hil_version"; return; }
  apt-cache depends linux-image-amd64 | sed -n 's/.*Depends: linux-image-//p' | head -n 1
}

hil_download() {
  (cd "$hil_build" && apt-get download --quiet "$1" >/dev/null && ls -t "${1%%=*}"_*.deb | head -n 1)
}

# In the kernel's source and not in Debian's kernel.
hil_test_drivers=(irq_sim gpio-sim pps-ktimer)

# The tree of the stock kernel, unpacked, with the test drivers that it was built without.
hil_kernel() {
  local version tree complete
  version=$(hil_version)
  tree=$hil_build/kernel-$version
  complete=$tree/complete-with-$(IFS=-; echo "${hil_test_drivers[*]}")
  if [ ! -e "$complete" ]; then
    mkdir -p "$tree"
    dpkg-deb --extract "$hil_build/$(hil_download "linux-image-$version")" "$tree"
    hil_build_test_drivers "$version" "$tree"
    depmod --basedir "$tree" "$version"
    touch "$complete"
  fi
  echo "$tree"
}

hil_build_test_drivers() {
  local version=$1 tree=$2 work=$hil_build/modules-$1 archive
  archive=$(ls /usr/src/linux-source-*.tar.xz | tail -n 1)
  mkdir -p "$work"
  tar --extract --xz --file "$archive" --directory "$work" --strip-components=3 \
    --wildcards '*/drivers/gpio/gpio-sim.c' '*/drivers/gpio/gpiolib.h'
  tar --extract --xz --file "$archive" --directory "$work" --strip-components=3 --wildcards '*/kernel/irq/irq_sim.c'
  tar --extract --xz --file "$archive" --directory "$work" --strip-components=4 \
    --wildcards '*/drivers/pps/clients/pps-ktimer.c'
  mkdir -p "$work/include"
  mv "$work/gpiolib.h" "$work/include/"
  # irq_sim.c is meant to be part of the kernel: as a module it may not use irq_to_desc(), and
  # must state its licence.
  sed -i 's/irq_to_desc(irqnum)/irq_data_to_desc(irq_get_irq_data(irqnum))/' "$work/irq_sim.c"
  printf '\n#include <linux/module.h>\nMODULE_LICENSE("GPL");\n' >>"$work/irq_sim.c"
  # shellcheck disable=SC2016 # $(src) is make's
  printf 'obj-m += %s\nccflags-y += -I$(src)/include\n' "${hil_test_drivers[*]/%/.o}" >"$work/Kbuild"
  make --quiet --directory "/usr/src/linux-headers-$version" M="$work" modules >"$work/make.log" 2>&1 ||
    { tail -n 20 "$work/make.log" >&2; return 1; }
  mkdir -p "$tree/lib/modules/$version/updates"
  cp "$work"/*.ko "$tree/lib/modules/$version/updates/"
}

# Copies a file and, of a program or library, all that the loader will look for.
hil_put() {
  local from=$1 to=$2 root=$3 library
  mkdir -p "$root$(dirname "$to")"
  cp --recursive --dereference "$from" "$root$to"
  find "$from" -type f \( -perm /111 -o -name '*.so*' \) -print0 |
    { xargs -0 -r ldd 2>/dev/null || true; } |  # it fails where a file needs no loader
    sed -n 's/.*=> \(\/[^ ]*\).*/\1/p; s/^\t\(\/[^ ]*\) (.*/\1/p' | sort -u | while read -r library; do
    [ -e "$root$library" ] || { mkdir -p "$root$(dirname "$library")"; cp --dereference "$library" "$root$library"; }
  done
}

hil_put_modules() {
  local tree=$1 version=$2 root=$3 module file
  for module in "${hil_modules[@]}"; do
    modprobe --dirname "$tree" --set-version "$version" --show-depends "${module%% *}"
  done | sed -n 's/^insmod \([^ ]*\).*/\1/p' | sort -u | while read -r file; do
    mkdir -p "$root/$(dirname "${file#"$tree"/}")"
    cp "$file" "$root/${file#"$tree"/}"
    strip --strip-debug "$root/${file#"$tree"/}"
  done
  mkdir -p "$root/lib/modules/$version"
  cp "$tree/lib/modules/$version"/modules.{builtin,builtin.modinfo,order} "$root/lib/modules/$version/"
  depmod --basedir "$root" "$version"
}

hil_put_udev() {
  local root=$1 udev=$hil_build/udev rule
  [ -d "$udev" ] || dpkg-deb --extract "$hil_build/$(hil_download udev)" "$udev"
  LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/systemd:/lib/systemd hil_put "$udev/bin/udevadm" /bin/udevadm "$root"
  mkdir -p "$root/lib/systemd" "$root/lib/udev/rules.d" "$root/etc"
  ln -sf /bin/udevadm "$root/lib/systemd/systemd-udevd"
  for rule in 50-udev-default 60-persistent-v4l 60-serial; do
    cp "$udev/lib/udev/rules.d/$rule.rules" "$root/lib/udev/rules.d/"
  done
  cp "$udev/lib/udev/v4l_id" "$root/lib/udev/"
  printf 'root:x:0:\ntty:x:5:\ndialout:x:20:\nvideo:x:44:\n' >"$root/etc/group"
  printf 'root:x:0:0::/root:/bin/sh\n' >"$root/etc/passwd"
}

# hil_image CASE COMMANDS: an initramfs that runs the shell commands as the case.
hil_image() {
  local name=$1 commands=$2 tree version root applet program file
  tree=$(hil_kernel)
  version=$(hil_version)
  root=$hil_build/$name/root
  rm -rf "$root"
  mkdir -p "$root"/{bin,sbin,usr/bin,usr/sbin,etc,dev,proc,sys,run,tmp,root,guest}
  cp /bin/busybox "$root/bin/busybox"
  for applet in $(busybox --list); do
    [ "$applet" = busybox ] || ln -sf busybox "$root/bin/$applet"
  done
  rm -f "$root"/bin/{modprobe,insmod,rmmod,lsmod,depmod}
  hil_put "$(readlink -f "$(command -v kmod)")" /bin/kmod "$root"
  for applet in modprobe insmod rmmod lsmod; do ln -sf kmod "$root/bin/$applet"; done
  for program in "${hil_programs[@]}"; do
    program=$(command -v "$program")
    hil_put "$program" "/bin/$(basename "$program")" "$root"
  done
  for file in "${hil_files[@]}"; do hil_put "${file%%:*}" "${file#*:}" "$root"; done
  if [ "$hil_udev" = yes ]; then hil_put_udev "$root"; fi
  hil_put_modules "$tree" "$version" "$root"
  printf '%s\n' "${hil_modules[@]}" >"$root/guest/modules"
  install -m 755 "$hil_source/tests/hil/guest/init" "$root/init"
  install -m 755 "$hil_source/tests/hil/guest/"{await,hand} "$root/bin/"
  printf '%s\n' "$commands" >"$root/guest/case"
  (cd "$root" && find . | cpio --quiet --create --format=newc --owner 0:0) >"$hil_build/$name/initrd"
}

# Arguments for QEMU: two character devices, of which each reads what the other writes.
hil_wire() {
  local socket
  socket=$(mktemp --dry-run --tmpdir plumbline-hil-XXXXXX)
  echo "-chardev socket,id=$1,path=$socket,server=on,wait=off -chardev socket,id=$2,path=$socket"
}

# Arguments for QEMU: a guest that may plug and pull its own devices (guest/hand).
hil_hand() {
  echo "-device virtio-serial-pci $(hil_wire hand qmp) -mon chardev=qmp,mode=control" \
    "-device virtserialport,chardev=hand,name=hand"
}

# hil_boot CASE SECONDS [QEMU_ARGUMENT...]: what the case prints, and its exit status; 124 when it
# took longer than so many seconds, 125 when it ended without a status.
hil_boot() {
  local name=$1 seconds=$2 status=0
  shift 2
  # In the foreground, that is, in the process group of the case: ended with it.
  timeout --foreground --kill-after=5 "$seconds" qemu-system-x86_64 \
    -accel tcg,thread=multi -cpu "$hil_cpu" -machine pc -smp 2 -m 768 \
    -nodefaults -no-user-config -display none -no-reboot \
    -kernel "$(hil_kernel)/boot/vmlinuz-$(hil_version)" -initrd "$hil_build/$name/initrd" \
    -append "$hil_kernel_words $hil_append" \
    -serial "file:$hil_build/$name/kernel.log" -serial stdio \
    -device isa-debug-exit,iobase=0xf4,iosize=0x04 "$@" </dev/null || status=$?
  if [ "$status" = 124 ] || [ "$status" = 137 ]; then return 124; fi
  if [ $((status % 2)) = 0 ]; then return 125; fi
  return $((status / 2))
}

hil_version=$(hil_version)  # asked once: apt-cache takes a second
