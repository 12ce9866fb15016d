"""The connection to the broker, by paho-mqtt: the one file that needs it."""

from __future__ import annotations

import asyncio
import ssl
import threading
import time
from typing import Any, Callable, List, Mapping, Optional

import paho.mqtt.client as mqtt
from paho.mqtt.enums import CallbackAPIVersion

from dolphin.posting import Remarks

from . import configuration

KEEPALIVE = 30
"""Seconds without any traffic after which the broker is asked whether it is there."""
LEAST, MOST = 0.5, 60.0
"""Seconds between two attempts to connect: at first, and at most. They double at each attempt."""

Hear = Callable[[str, bytes, bool], None]
"""Takes the topic, the payload, and whether the message was retained."""


class Broker:
    """Subscriptions to topics, each with its quality of service. It connects, and connects again, until `close`. It
    reports an outage once for each reason, and its end."""

    def __init__(self, broker: configuration.Broker, topics: Mapping[str, int], hear: Hear, remarks: Remarks) -> None:
        self._broker, self._topics, self._hear, self._remarks = broker, dict(topics), hear, remarks
        self._loop = asyncio.get_running_loop()
        self._closing = threading.Event()
        self._reasons: List[str] = []
        """The reasons of the outage that were reported."""
        self._since: Optional[float] = None
        """The moment from which the connection has been there."""
        self._refusal: Optional[str] = None
        # A new session each time: what was sent meanwhile is lost, and not heard late.
        self._client = client = mqtt.Client(CallbackAPIVersion.VERSION2, reconnect_on_failure=False)
        client.on_connect, client.on_subscribe, client.on_message = self._connected, self._subscribed, self._message
        if broker.username is not None:
            client.username_pw_set(broker.username, broker.password)
        if broker.tls:
            client.tls_set_context(ssl.create_default_context(cafile=broker.cafile))
        self._thread = threading.Thread(target=self._live, daemon=True)

    def open(self) -> None:
        """Begins to connect."""
        self._thread.start()

    def close(self) -> None:
        """Disconnects."""
        self._closing.set()
        self._client.disconnect()
        self._thread.join(2.0)

    # In the thread of the connection.

    def _live(self) -> None:
        pause = LEAST
        while not self._closing.is_set():
            self._since, self._refusal = None, None
            try:
                self._client.connect(self._broker.host, self._broker.port, KEEPALIVE)
                code = self._client.loop_forever()
                reason = self._refusal or (
                    "the connection ended before it was accepted" if self._since is None
                    else mqtt.error_string(code).rstrip(".").lower())
            except Exception as error:  # also of paho, by bytes that are not MQTT: the thread has to go on
                reason = reason_of(error)
            if self._closing.is_set():
                return
            if reason not in self._reasons:
                self._reasons.append(reason)
                self._call(self._remarks.now, f"broker {self._broker}: {reason}; it is tried again")
            # A broker that ends each connection at once is not asked faster for it.
            if self._since is not None and time.monotonic() - self._since > MOST:
                pause = LEAST
            self._closing.wait(pause)
            pause = min(2 * pause, MOST)

    def _connected(self, client: mqtt.Client, data: Any, flags: Any, code: Any, properties: Any) -> None:
        if code.is_failure:
            self._refusal = f"refuses the connection: {str(code).lower()}"
            return
        self._since, self._reasons = time.monotonic(), []
        self._call(self._remarks.now, f"broker {self._broker}: connected")
        client.subscribe(list(self._topics.items()))

    def _subscribed(self, client: mqtt.Client, data: Any, mid: int, codes: List[Any], properties: Any) -> None:
        for topic, code in zip(self._topics, codes):
            if code.is_failure:
                self._call(self._remarks.once, f"broker {self._broker}: refuses the subscription to {topic}")

    def _message(self, client: mqtt.Client, data: Any, message: mqtt.MQTTMessage) -> None:
        self._call(self._hear, message.topic, message.payload, message.retain)

    def _call(self, work: Callable[..., None], *arguments: Any) -> None:
        try:
            self._loop.call_soon_threadsafe(work, *arguments)
        except RuntimeError:  # the loop is closed: this process is about to end
            pass


def reason_of(error: Exception) -> str:
    """The reason of a connection that failed, in a few words."""
    if isinstance(error, ssl.SSLCertVerificationError):
        return f"its certificate is not accepted: {error.verify_message}"
    if isinstance(error, ssl.SSLError):
        return f"TLS fails: {error.reason or error}"
    if isinstance(error, OSError) and error.strerror:
        return error.strerror
    return str(error) or type(error).__name__
