"""Joins the standard streams of this process and a Unix socket: `python bridge.py SOCKET`. Dolphin starts it as the
adapter or the supplier of a run that another Python process serves (`dolphin.runs`). The standard library alone, so
that it runs as a script from anywhere."""

import os
import socket
import sys
import threading


def to_socket(connection: socket.socket) -> None:
    """Copies the standard input to the socket, to its end."""
    try:
        while True:
            data = os.read(0, 65536)
            if not data:
                break
            connection.sendall(data)
        connection.shutdown(socket.SHUT_WR)
    except OSError:
        pass


def main(path: str) -> int:
    """Returns when the other process closes the connection."""
    connection = socket.socket(socket.AF_UNIX)
    try:
        connection.connect(path)
    except OSError as error:
        print(f"{path}: {error}", file=sys.stderr)
        return 1
    threading.Thread(target=to_socket, args=(connection,), daemon=True).start()
    try:
        while True:
            data = connection.recv(65536)
            if not data:
                return 0
            while data:
                data = data[os.write(1, data):]
    except OSError:
        return 0


if __name__ == "__main__":
    status = main(sys.argv[1])
    os._exit(status)
