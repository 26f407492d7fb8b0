#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts `lightwell serve` under faults for minutes: slow readers, resets, malformed requests, silence, packs replaced or cut while
they are sent, and more connections than it has descriptors. All the while a fresh client is answered quickly, and rightly, and
the server's memory stays where it was; in the end SIGTERM lets an answer under way be finished.

  server_soak.py PROGRAM PACK [--seconds 120] [--seed 1]
"""

import argparse
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time

DESCRIPTORS = 256        # of the server
CLIENTS = 300            # misbehaving ones at a time: more than the descriptors
MOST_SECONDS = 0.05      # within which a fresh client is answered: half of a tenth, which nobody notices
MOST_GROWTH = 30 << 20   # of the server's memory, bytes
GRACE = 5                # seconds


def resident(process):
    for line in open(f"/proc/{process}/status"):
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) * 1024
    raise ProcessLookupError("the server has gone")


def processor_seconds(process):
    fields = open(f"/proc/{process}/stat").read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Served:
    """A running server of a folder of packs."""

    def __init__(self, program, packs):
        limit = (DESCRIPTORS, DESCRIPTORS)
        self.process = subprocess.Popen(
            [program, "serve", packs, "--port", "0", "--json", "--connections-per-address", "0", "--grace", str(GRACE)],
            stdout=subprocess.PIPE, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, limit))
        url = json.loads(self.process.stdout.readline())["url"]
        self.port = int(url.rstrip("/").rsplit(":", 1)[1])

    def connect(self, receive_buffer=None):
        connection = socket.socket()
        if receive_buffer:
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        connection.settimeout(5)
        connection.connect(("127.0.0.1", self.port))
        return connection


def request(name, more=""):
    return f"GET /packs/{name} HTTP/1.1\r\nHost: soak\r\n{more}\r\n".encode()


def answer(connection):
    """The head and the body of an answer."""
    received = b""
    while b"\r\n\r\n" not in received:
        piece = connection.recv(65536)
        if not piece:
            raise ConnectionError("closed before an answer")
        received += piece
    head, body = received.split(b"\r\n\r\n", 1)
    fields = dict(line.split(": ", 1) for line in head.decode().split("\r\n")[1:])
    while len(body) < int(fields["Content-Length"]):
        piece = connection.recv(65536)
        if not piece:
            raise ConnectionError("cut")
        body += piece
    return head, body


def waiting_seconds(process):
    """How long a process has waited for a processor that others had."""
    return int(open(f"/proc/{process}/schedstat").read().split()[1]) * 1e-9


def fresh_client(served, content):
    """Asks for a part of the pack that stays; returns the seconds that it took, less those that server and client waited for a
    processor: what else the machine does is not the server's fault."""
    both = (served.process.pid, os.getpid())
    waited = sum(map(waiting_seconds, both))
    begin = time.monotonic()
    connection = served.connect()
    connection.sendall(request("steady.glb", "Range: bytes=1000-66535\r\n"))
    head, body = answer(connection)
    seconds = time.monotonic() - begin - (sum(map(waiting_seconds, both)) - waited)
    connection.close()
    if not head.startswith(b"HTTP/1.1 206 ") or body != content[1000:66536]:
        raise ConnectionError("another answer: " + head.decode().split("\r\n")[0])
    return max(seconds, 0)


def noise(chance):
    return bytes(chance.randrange(256) for _ in range(chance.randrange(1, 400)))


MALFORMED = [
    b"\r\n\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"GET / HTTP/1.1\r\n\r\n", b"\x16\x03\x01\x02\x00\x01\x00",
    b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", b"GET /../../etc/passwd HTTP/1.1\r\nHost: a\r\n\r\n",
    b"GET /%00 HTTP/1.1\r\nHost: a\r\n\r\n", b"GET / HTTP/1.1\r\nHost: a\r\nRange: bytes=9-1,,-\r\n\r\n",
    b"POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 99999999999999999999\r\n\r\n",
    b"GET / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n", b"GET / HTTP/1.1\r\nX: " + b"y" * 20000,
]


class Misbehaving:
    """One connection with a fault, for some seconds."""

    def __init__(self, served, chance):
        self.chance = chance
        self.end = time.monotonic() + chance.uniform(0.1, 8)
        self.kind = chance.choice(["slow", "slow", "reset", "malformed", "silent", "dripping", "leaving"])
        self.connection = served.connect(4096 if self.kind == "slow" else None)
        self.connection.setblocking(False)
        name = chance.choice(["steady.glb", "replaced.glb", "cut.glb"])
        if self.kind == "malformed":
            self.send(chance.choice(MALFORMED + [noise(chance)]))
        elif self.kind == "dripping":
            self.send(b"GET / HT")
        elif self.kind != "silent":
            self.send(request(name))

    def send(self, data):
        try:
            self.connection.send(data)
        except OSError:
            self.end = 0

    def turn(self):
        """Goes on a little. False when it is over."""
        if time.monotonic() > self.end:
            if self.kind == "reset":
                self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            self.connection.close()
            return False
        if self.kind == "slow" and self.chance.random() < 0.2:
            try:
                self.connection.recv(512)
            except BlockingIOError:
                pass
            except OSError:
                self.end = 0
        if self.kind == "dripping" and self.chance.random() < 0.05:
            self.send(b"x")
        return True


def change_files(folder, content, chance):
    """Replaces one pack by another, as `lightwell bake` does, and cuts or restores one in its place."""
    new = folder / "new"
    new.write_bytes(content + bytes(chance.randrange(3) * 4))
    new.rename(folder / "replaced.glb")
    with open(folder / "cut.glb", "r+b") as file:
        if chance.random() < 0.5:
            file.truncate(chance.randrange(len(content)))
        else:
            file.write(content)


def soak(served, folder, content, seconds, chance):
    """Returns the seconds in which fresh clients were answered, and the server's memory before and at most."""
    process = served.process.pid
    for _ in range(20):
        fresh_client(served, content)
    before = most = resident(process)
    crowd, latencies = [], []
    end = time.monotonic() + seconds
    next_change = next_client = 0
    made = 0
    while time.monotonic() < end:
        now = time.monotonic()
        for _ in range(min(20, CLIENTS - len(crowd))):
            try:
                crowd.append(Misbehaving(served, chance))
                made += 1
            except OSError:
                break  # the queue of the system is full for a moment
        crowd = [each for each in crowd if each.turn()]
        if now >= next_change:
            change_files(folder, content, chance)
            next_change = now + 0.2
        if now >= next_client:
            try:
                latencies.append(fresh_client(served, content))
            except OSError:
                latencies.append(float("inf"))  # sent away: more connections than descriptors
            most = max(most, resident(process))
            next_client = now + 0.1
        time.sleep(0.005)
    for each in crowd:
        each.connection.close()
    print(f"{made} connections with faults; of {len(latencies)} fresh clients meanwhile "
          f"{sum(each > MOST_SECONDS for each in latencies)} were not answered in {1000 * MOST_SECONDS:.0f} ms")
    return latencies, before, most


def drained(served, content):
    """SIGTERM while a slow client reads: it gets all, then the server ends with status 0."""
    connection = served.connect(65536)
    connection.sendall(request("steady.glb"))
    received = connection.recv(1000)
    served.process.send_signal(signal.SIGTERM)
    try:
        while piece := connection.recv(65536):
            received += piece
    except OSError as error:
        print("cut while draining:", error)
    return received.endswith(content) and served.process.wait(GRACE + 5) == 0


def median(values):
    return sorted(values)[len(values) // 2]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("pack")
    parser.add_argument("--seconds", type=float, default=120)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    content = pathlib.Path(options.pack).read_bytes()
    failures = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for pack in ("steady.glb", "replaced.glb", "cut.glb"):
            shutil.copy(options.pack, folder / pack)
        served = Served(options.program, name)
        try:
            latencies, before, most = soak(served, folder, content, options.seconds, random.Random(options.seed))
            # Nine of ten: without descriptors some are told to come again.
            if sorted(latencies)[len(latencies) * 9 // 10] > MOST_SECONDS:
                failures.append("fresh clients were not answered in time during the faults")
            after = median([fresh_client(served, content) for _ in range(9)])
            print(f"afterwards a fresh client is answered in {1000 * after:.1f} ms; memory {before >> 10} KB, "
                  f"at most {most >> 10} KB; {processor_seconds(served.process.pid):.1f} s of a processor")
            if after > MOST_SECONDS:
                failures.append("a fresh client is not answered in time afterwards")
            if most - before > MOST_GROWTH:
                failures.append(f"the memory grew by {(most - before) >> 20} MB")
            if served.process.poll() is not None:
                failures.append("the server has ended")
            elif not drained(served, content):
                failures.append("an answer under way was not finished after SIGTERM")
        finally:
            served.process.kill()
            served.process.wait()
    for failure in failures:
        print("FAILED:", failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
