#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A USB cable between a receiver and the virtual companion computer, pulled on request.

Usage: cable.py FOLDER

Connects to the sockets that qemu opens in FOLDER:
  near.sock     the far end of the guest's USB serial port
  far.sock      a serial port of the guest's by which a test says what the receiver is to send
  control.sock  another, by which it says "pull" or "plug", a line each
  qmp.sock      qemu's monitor
Ends when qemu does.
"""
import json
import os
import selectors
import socket
import sys
import time

PORT = {"driver": "usb-serial", "id": "receiver", "chardev": "near", "bus": "usb.0"}
PATIENCE_S = 60


def connect(path):
    """The socket, as soon as qemu has opened it."""
    end = time.monotonic() + PATIENCE_S
    while True:
        link = socket.socket(socket.AF_UNIX)
        try:
            link.connect(path)
            return link
        except OSError:
            link.close()
            if time.monotonic() > end:
                sys.exit(f"cable: {path} did not open within {PATIENCE_S} s")
            time.sleep(0.05)


class Monitor:
    """qemu's machine protocol: one command at a time."""

    def __init__(self, path):
        self.stream = connect(path).makefile("rw")
        self.stream.readline()
        self.run("qmp_capabilities")

    def run(self, command, **arguments):
        self.stream.write(json.dumps({"execute": command, "arguments": arguments}) + "\n")
        self.stream.flush()
        while True:
            answer = json.loads(self.stream.readline())
            if "return" in answer:
                return
            if "error" in answer:
                print(f"cable: {command}: {answer['error']['desc']}", file=sys.stderr, flush=True)
                return

    def wait_until_gone(self, device):
        """device_del only asks for it; the port's other end is free when this has come."""
        while True:
            event = json.loads(self.stream.readline())
            if event.get("event") == "DEVICE_DELETED" and event["data"].get("device") == device:
                return


def obey(line, monitor):
    if line == b"pull":
        monitor.run("device_del", id=PORT["id"])
        monitor.wait_until_gone(PORT["id"])
    elif line == b"plug":
        monitor.run("device_add", **PORT)
    else:
        print(f"cable: no such order: {line!r}", file=sys.stderr, flush=True)


def main(folder):
    near, far, control = (connect(os.path.join(folder, name + ".sock"))
                          for name in ("near", "far", "control"))
    monitor = Monitor(os.path.join(folder, "qmp.sock"))
    near.setblocking(False)
    waiting = selectors.DefaultSelector()
    for link in (near, far, control):
        waiting.register(link, selectors.EVENT_READ)
    orders = b""
    while True:
        for key, _ in waiting.select():
            data = key.fileobj.recv(65536)
            if not data:
                return
            if key.fileobj is control:
                *lines, orders = (orders + data).split(b"\n")
                for line in lines:
                    obey(line.strip(), monitor)
            elif key.fileobj is far:
                try:
                    near.send(data)
                except BlockingIOError:
                    pass  # nobody reads while the cable is out


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
