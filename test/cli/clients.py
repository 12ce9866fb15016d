"""Clients of the socket of a run: clients.py SOCKET WHAT [N]."""
import json
import socket
import sys
import threading


def connect(path):
    s = socket.socket(socket.AF_UNIX)
    s.connect(path)
    return s, s.makefile("rw", encoding="utf-8")


def ask(lines, **request):
    lines.write(json.dumps(request) + "\n")
    lines.flush()
    return json.loads(lines.readline())


def post(path, n):
    """Posts n: 0, n: 1, ..., each when the one before is taken."""
    _, lines = connect(path)
    replies = [ask(lines, request="post", key="n", value=i, id=i) for i in range(n)]
    return sum(r.get("ok") is True and r["id"] == i for i, r in enumerate(replies))


WRONG = ["", "nothing", "[1]", "{}", '{"request": 3}', '{"request": "dance"}', '{"request": "post"}', "\x00",
         '{"request": "post", "key": "other", "value": 1}', '{"request": "post", "key": "n"}', "[" * 1000,
         '{"request": "post", "key": "n", "value": {"task": "p"}}', "x" * 70000, '{"request": "post", "key": 1, "value": 1}']


def garbage(path, n):
    """Sends wrong lines, and counts the errors that come back."""
    s, lines = connect(path)

    def send():
        for i in range(n):
            s.sendall((WRONG[i % len(WRONG)] + "\n").encode())
        s.shutdown(socket.SHUT_WR)

    threading.Thread(target=send).start()
    return sum("error" in json.loads(line) for line in lines)


def follow(path, n):
    """Follows the run n times until it ends, and once without ever reading; the lines that all have seen."""
    deaf, lines = connect(path)
    lines.write('{"request": "follow"}\n' * 3)
    lines.flush()
    seen = []

    def one():
        _, lines = connect(path)
        ask(lines, request="follow")
        seen.append([json.loads(line)["kind"] if i else "header" for i, line in enumerate(lines)])

    threads = [threading.Thread(target=one) for _ in range(n)]
    for t in threads:
        t.start()
    print("following", flush=True)
    for t in threads:
        t.join()
    deaf.close()
    return "%d of %d saw the end, all the same: %s" % (
        sum(s[-1] == "end" for s in seen), n, all(s == seen[0] for s in seen))


if __name__ == "__main__":
    path, what = sys.argv[1:3]
    if what == "talk":
        s, lines = connect(path)
        for request in sys.stdin:
            lines.write(request)
            lines.flush()
            print(lines.readline(), end="")
    elif what == "stop":
        print(ask(connect(path)[1], request="stop"))
    else:
        print({"post": post, "garbage": garbage, "follow": follow}[what](path, int(sys.argv[3])))
