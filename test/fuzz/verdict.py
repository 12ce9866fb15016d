"""Runs a command within limits, and finds faults in its exit status and its output."""

import json
import math
import os
import re
import signal
import subprocess
import tempfile
import xml.parsers.expat

MEMORY = 1 << 20  # KiB of address space
# Control characters, ends of lines and changes of direction in Unicode, and characters that XML does not have.
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ufffe\uffff]")
LIMITED = 'ulimit -S -t "$1"; ulimit -v "$2"; ulimit -c 0; shift 2; exec "$@"'


class Ended:
    """The result of a process: its status (negative: the signal), its output, whether it was killed for running on."""

    def __init__(self, status, out, err, hangs):
        self.status, self.out, self.err, self.hangs = status, out, err, hangs


class Running:
    """A process that has `seconds` of the processor's time, and as much other time as a loaded machine needs."""

    def __init__(self, command, cwd, seconds, stdin=b""):
        self.seconds = seconds
        self.files = [tempfile.TemporaryFile() for _ in range(3)]
        self.files[0].write(stdin)
        self.files[0].seek(0)
        self.process = subprocess.Popen(
            ["sh", "-c", LIMITED, "sh", str(seconds), str(MEMORY), *command], cwd=cwd, start_new_session=True,
            stdin=self.files[0], stdout=self.files[1], stderr=self.files[2])

    def wait(self, seconds):
        try:
            self.process.wait(seconds)
            return True
        except subprocess.TimeoutExpired:
            return False

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)

    def end(self, interrupt_after=None):
        """Waits until the process ends; interrupts it after this number of seconds if it may run until then."""
        if interrupt_after is not None:
            for _ in range(2):
                if not self.wait(interrupt_after):
                    self.interrupt()
        hangs = not self.wait(3 * self.seconds)
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        status = self.process.wait()
        texts = []
        for file in self.files:
            file.seek(0)
            texts.append(file.read())
            file.close()
        return Ended(status, texts[1], texts[2], hangs or status == -signal.SIGXCPU)


def finite(text):
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(f"{text} is not finite")
    return number


def not_json(constant):
    raise ValueError(f"{constant} is not JSON")


def bad_json(text):
    """Why `text`, valid UTF-8, is not valid JSON; or None."""
    try:
        value = json.loads(text, parse_float=finite, parse_constant=not_json)
        json.dumps(value, ensure_ascii=False).encode()
    except RecursionError:
        return None  # Python's own limit
    except ValueError as error:
        return f"not JSON: {error}"
    return None


def bad_lines(text):
    return next((why for line in text.split("\n") if line and (why := bad_json(line))), None)


def bad_xml(text):
    try:
        xml.parsers.expat.ParserCreate().Parse(text.encode(), True)
    except xml.parsers.expat.ExpatError as error:
        return f"not XML: {error}"
    return None


def bad_text(text):
    found = CONTROL.search(text)
    return found and f"control character {ord(found.group()):#04x}"


def bad_frames(text):
    """Why `text` is not a sequence of messages of the Language Server Protocol."""
    data = text.encode()
    while data:
        header, separator, rest = data.partition(b"\r\n\r\n")
        length = re.search(rb"Content-Length: (\d+)", header)
        if not separator or not length:
            return f"not a message: {header[:40]!r}"
        body, data = rest[:int(length.group(1))], rest[int(length.group(1)):]
        try:
            why = bad_json(body.decode())
        except UnicodeDecodeError as error:
            why = f"invalid UTF-8: {error}"
        if why:
            return why
    return None


FORMS = {"text": bad_text, "json": bad_json, "lines": bad_lines, "xml": bad_xml, "frames": bad_frames,
         "source": lambda _: None}


def bad_output(name, form, data):
    """The fault of the bytes `data` of a stream or file `name`, which has the form `form`; or None."""
    if form == "bytes":
        return None
    try:
        why = data and FORMS[form](data.decode())
    except UnicodeDecodeError as error:
        why = f"invalid UTF-8: {error}"
    return f"{name}: {why}" if why else None


def judge(ended, form):
    """The fault of a process; or None. Its standard output has the form `form`."""
    if ended.hangs:
        return "does not end"
    if ended.status not in (0, 1, 2, 3, 130):
        return f"ends with {ended.status}" if ended.status >= 0 else f"dies of signal {-ended.status}"
    if re.search(rb"[Oo]ut[ _]of[ _]memory|not enough memory", ended.err):
        return "needs more than 1 GB"
    if b"Traceback" in ended.err:
        return "an adapter of ours raises an exception"
    return bad_output("standard output", form, ended.out) or bad_output("standard error", "text", ended.err)
