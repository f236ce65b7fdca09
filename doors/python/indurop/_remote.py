# SPDX-License-Identifier: Apache-2.0
"""A board of `indurop serve`, on this host or another one, with the interface of a node of this machine."""

from __future__ import annotations

import asyncio
import time
from typing import Any, AsyncIterator, Iterator

from indurop._by_name import ByName
from indurop._described import Described
from indurop._errors import Error, Forced, Invalid, NotFound, OutOfRange, Timeout
from indurop._form import layout_of, text_of, value_of
from indurop._node import Quality, held_ns
from indurop._server import Server
from indurop._subscription import Subscription

_LONGEST_WAIT_S = 0.2  # of a thread that an asyncio watch has left


class RemoteVariable(Described):
    """A variable of a board, or a part of one."""

    parameter = False  # a server does not say

    def __init__(self, node: "RemoteNode", name: str) -> None:
        self._node = node
        about = node._server.get("boards", node.name, "variables", name)
        self._form = about["form"]
        self.name = about["name"]
        self.type = about["type"]
        self.unit = about["unit"]
        self.description = about["description"]
        self.source = about["source"]
        self.retain = about["retain"]
        limits = about["range"]
        self.range = None if limits is None else (_limit(limits["min"], "-inf"), _limit(limits["max"], "inf"))
        self.layout = layout_of(self._form)
        self.size = self.layout.size

    def _ask(self, **query: str) -> Any:
        found = self._node._server.get("boards", self._node.name, "variables", self.name, **query)
        if found["form"] != self._form:
            self._node.refresh()  # so that the node takes it again
            raise NotFound(f"{self.name} has another type now, {found['type']}; take it from the node again")
        return found

    @property
    def value(self) -> Any:
        """The value as Python sees it. A server of an earlier release sends no bytes, only JSON: it has neither NaN nor
        infinities, which then are NaN, except in single numbers."""
        found = self._ask(values="bytes")
        if "bytes" in found:
            return self.value_of(bytes.fromhex(found["bytes"]))
        if found["value"] is None and self.layout.base in ("f32", "f64") and not self.layout.dims:
            return float(found["text"])
        return value_of(self.layout, found["value"])

    @value.setter
    def value(self, value: Any) -> None:
        self.write(value)

    def value_of(self, data: bytes) -> Any:
        """Returns the value that these bytes stand for."""
        return self.layout.value(data)

    def _change(self, act: str, value: Any, **more: Any) -> None:
        self.layout.store(value, bytearray(self.size))  # raises OutOfRange as a node of this machine would
        body = {"values": {self.name: text_of(self.layout, value)}, **more}
        try:
            self._node._server.post("boards", self._node.name, act, body=body)
        except OutOfRange as error:
            if act == "set" and self._ask()["forced"]:
                raise Forced(str(error)) from error
            raise

    def write(self, value: Any, reason: str = "") -> None:
        """Sets the value once. Fields that a dict leaves out keep their values."""
        self._change("set", value, reason=reason)

    def force(self, value: Any, seconds: float = 0, reason: str = "") -> None:
        """Holds the value against all writers, for `seconds` or, 0, until it is released."""
        self._change("force", value, reason=reason, **({"for_ns": held_ns(seconds)} if seconds != 0 else {}))

    def release(self, reason: str = "") -> None:
        body = {"names": [self.name], "reason": reason}
        if not self._node._server.post("boards", self._node.name, "release", body=body)["released"]:
            raise NotFound(f"{self.name} is not forced")

    @property
    def quality(self) -> Quality:
        """`silent` is also what is older than its maximum age."""
        found = self._ask()
        age = found["age_ns"]
        lost = found["quality"] != "good"
        return Quality(bool(found["forced"]), lost or age is not None, lost, lost and age is None, (age or 0) / 1e9)

    def _subscription(self, rate_hz: float) -> Subscription:
        return Subscription(self._node._server, self._node.name, self.name, self._form, self.layout, rate_hz)

    def watch(self, timeout: float | None = None, rate_hz: float = 25) -> Iterator[Any]:
        """Yields the value now and after each change; the server reads `rate_hz` (0.1 to 100) times a second, and
        changes in between are one. Ends with the node; raises Timeout if nothing changed for `timeout` seconds."""
        last = None
        changed = time.monotonic()
        with self._subscription(rate_hz) as subscription:
            while True:
                sample = subscription.next(1.0 if timeout is None else timeout)
                if sample is not None and sample[0] != last:
                    last = sample[0]
                    changed = time.monotonic()
                    yield self.value_of(last)
                if sample is not None and not sample[1]:
                    return
                if timeout is not None and time.monotonic() - changed > timeout:
                    raise Timeout(f"{self.name} did not change")

    async def watch_async(self, rate_hz: float = 25) -> AsyncIterator[Any]:
        """The same for asyncio, by a thread that waits."""
        last = None
        with await asyncio.to_thread(self._subscription, rate_hz) as subscription:
            while True:
                sample = await asyncio.to_thread(subscription.next, _LONGEST_WAIT_S)
                if sample is not None and sample[0] != last:
                    last = sample[0]
                    yield self.value_of(last)
                if sample is not None and not sample[1]:
                    return


class RemoteNode(ByName[RemoteVariable]):
    """A board of a server. `node["name"]` reads a value, `node["name"] = value` sets it, as for a node of this
    machine. Each is a request."""

    def __init__(self, server: Server, board: str) -> None:
        self._server = server
        self._known: dict[str, RemoteVariable] = {}
        names = [one["board"] for one in server.get("boards")["boards"]]
        if not board and len(names) != 1:
            raise Invalid(f"the server has {len(names)} boards; name one of them: {', '.join(names)}")
        if board and board not in names:
            raise NotFound(f"there is no board '{board}'; there is {', '.join(names) or 'none'}")
        self.name = board or names[0]

    def close(self) -> None:
        self._server.close()

    @property
    def running(self) -> bool:
        return any(one["board"] == self.name and one["alive"] for one in self._server.get("boards")["boards"])

    def refresh(self) -> None:
        """Forgets what is known of variables, after a deployment changed them."""
        self._known.clear()

    def _find(self, name: str) -> RemoteVariable:
        return RemoteVariable(self, name)

    def __getitem__(self, name: str) -> Any:
        return self.variable(name).value

    def __setitem__(self, name: str, value: Any) -> None:
        self.variable(name).write(value)

    def keys(self) -> list[str]:
        found = self._server.get("boards", self.name, "variables", values="false")
        return sorted(one["name"] for one in found["variables"])

    def __iter__(self) -> Iterator[str]:
        return iter(self.keys())

    def __len__(self) -> int:
        return len(self.keys())

    def __repr__(self) -> str:
        return f"<board {self.name} of {self._server.place}>"


def _limit(value: float | None, otherwise: str) -> float:
    return float(otherwise) if value is None else float(value)


def remote(address: str, board: str = "", *, token: str = "", ca: str = "", certificate: tuple[str, str] | None = None,
           user: str = "", password: str = "", timeout: float = 15) -> RemoteNode:
    """Opens a board of `indurop serve` at `address`: "desk:8080", or an address that the server printed, with its
    token. A board must be named if the server has several.

    `ca`: file of the authority that issued the server's certificate, ca.pem of the plant; with it, or "https://", the
    connection is TLS. `token`: of `--token-file` or of a user. `certificate`: files of a certificate and its key, for a
    server with `--client-ca`. `user` and `password`: signs in. `timeout`: seconds that a request may take. Raises
    Unreachable, Denied, NotFound."""
    server = Server(address, token, ca, certificate, timeout)
    try:
        if user:
            server.token = server.post("session", body={"user": user, "password": password})["token"]
        return RemoteNode(server, board)
    except Error:
        server.close()
        raise
