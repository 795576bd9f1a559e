#!/usr/bin/env python3
"""Stores what `liftsim monitor --tcp HOST:PORT` sends: each stream in a file of JSON lines.

usage: scripts/listen.py [PORT [FOLDER]]      (9000 and the current folder if left out; IPv6 and IPv4)

A line is synced before it is acknowledged. Whoever can reach the port can write: let only the monitors reach it.
The protocol is described in `liftsim monitor --help`. To do something with the events, do it in `store`.
"""
import json, os, socket, sys, threading

if sys.argv[1:2] in (["-h"], ["--help"]):
    sys.exit(__doc__)
PORT = int(sys.argv[1]) if len(sys.argv) > 1 else 9000
FOLDER = sys.argv[2] if len(sys.argv) > 2 else "."
connections, locks, guard = {}, {}, threading.Lock()


def store(file, line):
    file.write(line)
    file.flush()
    os.fsync(file.fileno())


def last(file):
    """The number of the last whole line; half of one, from a power cut, is cut off."""
    file.seek(0)
    whole = file.read().rpartition(b"\n")[0]
    file.truncate(len(whole) + 1 if whole else 0)
    file.seek(0, os.SEEK_END)
    return json.loads(whole.splitlines()[-1])["sequence"] if whole else 0


def serve(connection):
    with connection, connection.makefile("rb") as lines:
        stream = json.loads(lines.readline())["stream"]
        if not stream.isalnum():
            return
        # A new connection replaces the one before, which the monitor may have given up unnoticed.
        with guard:
            lock, before = locks.setdefault(stream, threading.Lock()), connections.get(stream)
            connections[stream] = connection
        if before:
            try:
                before.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass  # It has ended already.
        with lock, open(os.path.join(FOLDER, stream + ".jsonl"), "ab+") as file:
            number = last(file)
            connection.sendall(b"%d\n" % number)
            for line in lines:
                if line.endswith(b"\n") and json.loads(line)["sequence"] > number:
                    store(file, line)
                    number = json.loads(line)["sequence"]
                    connection.sendall(b"%d\n" % number)


def serve_quietly(connection):
    try:
        serve(connection)
    except Exception as error:  # Whoever connects may send anything.
        print(f"listen.py: a connection ended: {error}", file=sys.stderr)


with socket.create_server(("", PORT), family=socket.AF_INET6, dualstack_ipv6=True) as server:
    while True:
        threading.Thread(target=serve_quietly, args=[server.accept()[0]], daemon=True).start()
