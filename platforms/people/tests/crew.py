"""People who are programs, by the requests of the page: python crew.py LINK ... takes part for each link, until it is
ended. Instructions that begin with `long` are carried out until they are stopped, others are done after 0.2 s; the
answer to the N-th one is N. Each decision that was taken is a line of the standard output."""

import sys
import threading
import time

from dolphin_people.terminal import Connection, Refusal


def take_part(link):
    connection, number, decided = Connection(link, None), 0, {}
    while True:
        try:
            state = connection.get("/state")
            open_ = state["instruction"]
            act, value = None, None
            if open_ is not None and open_["state"] == "offered":
                act = "accept"
            elif open_ is not None and open_["state"] == "stopping":
                act = "stopped"
            elif open_ is not None and not open_["text"].startswith("long"):
                if open_["request"] not in decided:
                    time.sleep(0.2)
                    number += 1
                    decided[open_["request"]] = number
                act, value = "done", decided[open_["request"]] if open_["answer"] else None
            if act is not None:
                members = {"request": open_["request"], "act": act}
                connection.post("/act", members if value is None else {**members, "value": value})
                print(state["person"], act, open_["text"], "" if value is None else value, flush=True)
        except (OSError, ValueError, Refusal):
            pass
        time.sleep(0.03)


if __name__ == "__main__":
    for each in sys.argv[2:]:
        threading.Thread(target=take_part, args=(each,), daemon=True).start()
    take_part(sys.argv[1])
