#!/usr/bin/env python3
"""A small driver of a display for Vis2Hap (vis2hap.display/1) in Python's standard library: copy it, fill in Device.

    small_driver.py FILE.pgm         Vis2Hap starts it: --display "exec:python3 small_driver.py felt.pgm"
    small_driver.py FILE.pgm [ADDRESS:]PORT    it waits for connections: --display tcp:HOST:PORT

With a port alone, only this computer can connect. For another computer, name the address of your own end of the cable, or 0.0.0.0
for every network: nothing checks who connects.
"""
import json
import socket
import sys
import time

WIDTH, HEIGHT = 1280, 800  # pixels of your glass
LONGEST_LINE, MOST_BYTES = 65536, 64 << 20


class Device:
    """==== The one place for your vendor's calls. This example keeps the image in a file. ===="""

    def show(self, width, height, grey):
        """grey: width * height bytes, row by row from the upper left; 255 is the highest friction. Return when it can be felt;
        raise an exception with a reason for the operator if the engine fails."""
        with open(sys.argv[1], "wb") as file:
            file.write(b"P5\n%d %d\n255\n" % (width, height) + grey)

    def clear(self):
        """Nothing can be felt any more."""
        self.show(WIDTH, HEIGHT, bytes(WIDTH * HEIGHT))


def reply_to(device, request, stream, showing):
    """Reply without id, and the id of the image that can be felt from now on."""
    kind = request.get("type")
    if kind == "hello":
        return {"type": "hello", "schema": "vis2hap.display/1", "name": "small driver in Python", "width": WIDTH,
                "height": HEIGHT, "touches": False}, showing
    if kind == "show":
        size = request.get("bytes")
        if type(size) is not int or not 0 <= size <= MOST_BYTES:
            raise ConnectionError("the number of bytes is missing or too large")  # the next message could not be found any more
        grey = stream.read(size)
        if len(grey) != request["width"] * request["height"]:
            return {"type": "failed", "why": "width x height differs from the number of bytes"}, showing
        device.show(request["width"], request["height"], grey)
        return {"type": "shown", "at_s": time.monotonic()}, request["id"]
    if kind == "clear":
        device.clear()
        return {"type": "cleared", "at_s": time.monotonic()}, None
    return ({"type": "status", "showing": showing} if kind == "status" else {"type": "failed", "why": "unknown request"}), showing


def clear_for_nobody(device):
    """Clears while no computer reads a reason."""
    try:
        device.clear()
    except Exception as fault:
        print("the device is not cleared:", fault, file=sys.stderr)


def serve(device, reading, writing):
    """Answers one computer until its input ends."""
    showing = None
    clear_for_nobody(device)
    try:
        while True:
            line = reading.readline(LONGEST_LINE)
            if not line.endswith(b"\n"):  # the end, or a line that is too long
                break
            number = 0
            try:
                request = json.loads(line)
                number = request.get("id", 0)
                reply, showing = reply_to(device, request, reading, showing)
            except ConnectionError:
                raise
            except Exception as fault:  # the operator reads the reason, and the session pauses
                reply = {"type": "failed", "why": str(fault)}
            writing.write(json.dumps(dict(reply, id=number)).encode() + b"\n")
            writing.flush()
    except (OSError, ValueError) as fault:
        print("the connection ends:", fault, file=sys.stderr)
    finally:
        clear_for_nobody(device)  # Vis2Hap has ended, perhaps by a crash


if len(sys.argv) == 2:
    serve(Device(), sys.stdin.buffer, sys.stdout.buffer)
elif len(sys.argv) == 3:
    address, _, port = sys.argv[2].rpartition(":")
    with socket.create_server((address or "127.0.0.1", int(port))) as server:
        print("listening at port", server.getsockname()[1], "of", server.getsockname()[0], flush=True)
        while True:
            client, _ = server.accept()
            client.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)  # a computer without power closes nothing
            with client, client.makefile("rb") as reading, client.makefile("wb") as writing:
                serve(Device(), reading, writing)
else:
    sys.exit(__doc__)
