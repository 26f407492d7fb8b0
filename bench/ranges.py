#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Requests a processor second of a server for ranges of 64 KB, over some kept connections at once.

  ranges.py NAME URL PROCESS [--requests 10000]

PROCESS is the server, or the parent of the processes that serve. Only its processor time counts, so this client's speed and the
machine's other work do not matter much.
"""

import argparse
import os
import selectors
import socket
import urllib.parse
import urllib.request

RANGE = 65536
CONNECTIONS = 16


def processor_seconds(process):
    """Of a process and its children, by the scheduler's nanoseconds."""
    children = open(f"/proc/{process}/task/{process}/children").read().split()
    return sum(int(open(f"/proc/{each}/schedstat").read().split()[0]) for each in [process, *children]) * 1e-9


class Connection:
    def __init__(self, place, host, path, length):
        self.host, self.path, self.length = host, path, length
        self.buffer = bytearray(RANGE + 4096)
        self.socket = socket.create_connection(place)
        self.asked = 0

    def ask(self, number):
        first = number * 4099 * 16 % (self.length - RANGE)
        self.missing = None
        self.socket.sendall(f"GET {self.path} HTTP/1.1\r\nHost: {self.host}\r\n"
                            f"Range: bytes={first}-{first + RANGE - 1}\r\n\r\n".encode())

    def read(self):
        """True when the answer is complete."""
        count = self.socket.recv_into(self.buffer)
        if count == 0:
            raise ConnectionError("closed")
        if self.missing is None:
            head = self.buffer.index(b"\r\n\r\n", 0, count) + 4
            assert b" 206 " in self.buffer[:32], self.buffer[:200]
            self.missing = RANGE + head
        self.missing -= count
        return self.missing == 0


def run(url, requests):
    parts = urllib.parse.urlsplit(url)
    with urllib.request.urlopen(urllib.request.Request(url, method="HEAD")) as head:
        length = int(head.headers["Content-Length"])
    selector = selectors.DefaultSelector()
    asked = 0
    for _ in range(CONNECTIONS):
        connection = Connection((parts.hostname, parts.port), parts.netloc, parts.path, length)
        connection.ask(asked)
        asked += 1
        selector.register(connection.socket, selectors.EVENT_READ, connection)
    done = 0
    while done < requests:
        for key, _ in selector.select():
            if not key.data.read():
                continue
            done += 1
            key.data.ask(asked)
            asked += 1
    for key in list(selector.get_map().values()):
        key.data.socket.close()
    return done


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("name")
    parser.add_argument("url")
    parser.add_argument("process", type=int)
    parser.add_argument("--requests", type=int, default=10000)
    options = parser.parse_args()
    run(options.url, 500)  # files in memory, connections warm
    before = processor_seconds(options.process)
    done = run(options.url, options.requests)
    rate = done / (processor_seconds(options.process) - before)
    print(f"{options.name}: {rate:.0f} ranges of 64 KB a processor second")


if __name__ == "__main__":
    main()
