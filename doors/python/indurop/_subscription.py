# SPDX-License-Identifier: Apache-2.0
"""Values of a board as they change, over the WebSocket of `indurop serve`. Needs websocket-client (Debian:
python3-websocket)."""

from __future__ import annotations

import json
import struct
import time
from typing import Any

from indurop._errors import Denied, NotFound, SystemFailure
from indurop._layout import Layout
from indurop._server import Server

_HEAD = struct.Struct("<BBHIQqq")  # version, kind, flags, stream, seq, time, wall-clock time
_SILENCE_S = 30.0  # a server sends a frame for each sample, changed or not
_TEXT, _CLOSE = 1, 8
_POLICY = 1008  # the code of a connection that is closed because the client may not have it any more


class Subscription:
    """Follows one variable, or a part of one."""

    def __init__(self, server: Server, board: str, name: str, form: Any, layout: Layout, rate_hz: float) -> None:
        try:
            import websocket
        except ImportError as error:
            raise SystemFailure("watching a board elsewhere needs websocket-client: apt install python3-websocket") from error
        self._errors = (websocket.WebSocketException, OSError)
        self._timeouts = websocket.WebSocketTimeoutException
        self._server = server
        self._form = form
        self._layout = layout
        self._request = {"type": "subscribe", "id": 1, "board": board, "names": [name], "rate_hz": rate_hz, "binary": True}
        self._stream = -1
        self._offset = 0
        self._heard = time.monotonic()
        protocols = ["indurop.v1"] + (["indurop.token." + server.token] if server.token else [])
        try:
            self._socket = websocket.create_connection(
                f"{'ws' if server.tls is None else 'wss'}://{server.place}/api/v1/stream", timeout=server.timeout,
                subprotocols=protocols, suppress_origin=True, http_no_proxy=["*"],
                sslopt={} if server.tls is None else {"context": server.tls})
            self._subscribe()
        except websocket.WebSocketBadStatusException as error:
            raise Denied(f"{server.place} refuses the stream: {error}") from error
        except self._errors as error:
            raise server.unreachable(error) from error

    def __enter__(self) -> "Subscription":
        return self

    def __exit__(self, *_: object) -> None:
        self._socket.close()

    def _subscribe(self) -> None:
        self._socket.send(json.dumps(self._request))

    def next(self, timeout: float) -> tuple[bytes, bool] | None:
        """Returns the bytes of the next sample and whether the node runs; None: there was none within this time."""
        end = time.monotonic() + timeout
        while (left := end - time.monotonic()) > 0:
            try:
                self._socket.settimeout(left)
                opcode, data = self._socket.recv_data()
            except self._timeouts:
                break
            except self._errors as error:
                raise self._server.unreachable(error) from error
            self._heard = time.monotonic()
            if opcode == _CLOSE:
                raise self._closed(data)
            if opcode == _TEXT:
                self._take_text(json.loads(data))
            elif (found := self._take_frame(data)) is not None:
                return found
        if time.monotonic() - self._heard > _SILENCE_S:
            raise self._server.unreachable(f"nothing came for {_SILENCE_S:.0f} s")
        return None

    def _closed(self, data: bytes) -> Exception:
        code = struct.unpack(">H", data[:2])[0] if len(data) >= 2 else 0
        why = data[2:].decode("utf-8", "replace") or f"closed with code {code}"
        return Denied(f"{self._server.place}: {why}") if code == _POLICY else self._server.unreachable(why)

    def _take_text(self, message: Any) -> None:
        kind = message["type"]
        if kind == "error" and message.get("id") == 1:
            raise NotFound(message["message"])
        if kind == "layout_changed" and 1 in message["ids"]:
            self._stream = -1
            self._subscribe()
        elif kind == "subscribed":
            if message["missing"]:
                raise NotFound(message["missing"][0]["message"])
            one = message["variables"][0]
            if one["form"] != self._form:
                raise NotFound(f"{one['name']} has another type now")
            self._stream = message["stream"]
            self._offset = one["offset"]

    def _take_frame(self, data: bytes) -> tuple[bytes, bool] | None:
        if len(data) < self._offset + self._layout.size or data[:2] != b"\x01\x01":
            return None
        _, _, flags, stream, *_ = _HEAD.unpack_from(data)
        if stream != self._stream:
            return None
        return bytes(data[self._offset:self._offset + self._layout.size]), bool(flags & 1)
