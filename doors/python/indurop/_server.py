# SPDX-License-Identifier: Apache-2.0
"""Requests to `indurop serve`, and its refusals as exceptions."""

from __future__ import annotations

import http.client
import json
import ssl
import urllib.parse
from typing import Any

from indurop._errors import (Busy, Denied, Error, Gone, Invalid, Locked, NotFound, OutOfRange, SystemFailure, Timeout,
                             Unreachable)

_PATH = "/api/v1/"
_BY_STATUS: dict[int, type[Error]] = {400: Invalid, 401: Denied, 403: Denied, 404: NotFound, 409: Gone, 422: OutOfRange,
                                      423: Locked, 503: Busy, 504: Timeout}


class Server:
    """One `indurop serve`. Connections are kept open between requests."""

    def __init__(self, address: str, token: str, ca: str, certificate: tuple[str, str] | None, timeout: float) -> None:
        secured = bool(ca) or certificate is not None
        url = urllib.parse.urlsplit(address if "://" in address else ("https://" if secured else "http://") + address)
        if url.scheme not in ("http", "https") or not url.hostname or (url.scheme == "http" and secured):
            raise Invalid(f"'{address}' is not an address like desk:8080 or https://desk:8080")
        self.host, self.port = url.hostname, url.port or (443 if url.scheme == "https" else 80)
        self.token = token or dict(urllib.parse.parse_qsl(url.fragment)).get("token", "")
        self.timeout = timeout
        self.tls: ssl.SSLContext | None = None
        if url.scheme == "https":
            self.tls = ssl.create_default_context(cafile=ca or None)
            if certificate is not None:
                self.tls.load_cert_chain(*certificate)
        self._connection: http.client.HTTPConnection | None = None

    @property
    def place(self) -> str:
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{host}:{self.port}"

    def get(self, *parts: str, **query: str) -> Any:
        path = _PATH + "/".join(urllib.parse.quote(one, safe="") for one in parts)
        path += "?" + urllib.parse.urlencode(query) if query else ""
        kept = self._connection is not None
        try:
            return self._request("GET", path, None)
        except Unreachable:
            if not kept:
                raise
            return self._request("GET", path, None)  # the server had closed the connection that was kept

    def post(self, *parts: str, body: dict[str, Any]) -> Any:
        """Is sent once, on a new connection: whether it was done is not known if the answer is lost."""
        self.close()
        return self._request("POST", _PATH + "/".join(urllib.parse.quote(one, safe="") for one in parts), body)

    def close(self) -> None:
        if self._connection is not None:
            self._connection.close()
            self._connection = None

    def unreachable(self, why: object) -> Unreachable:
        return Unreachable(f"{self.place} does not answer as a server of indurop: {why}")

    def _request(self, method: str, path: str, body: dict[str, Any] | None) -> Any:
        headers = {"Accept": "application/json"}
        if self.token:
            headers["Authorization"] = "Bearer " + self.token
        if body is not None:
            headers["Content-Type"] = "application/json"
        try:
            connection = self._connection or self._connect()
            self._connection = connection
            connection.request(method, path, None if body is None else json.dumps(body).encode(), headers)
            answer = connection.getresponse()
            text = answer.read()
        except (OSError, http.client.HTTPException) as error:
            self.close()
            raise self.unreachable(error or type(error).__name__) from error
        try:
            found = json.loads(text)
        except ValueError as error:
            raise self.unreachable(f"status {answer.status}, and no JSON") from error
        if answer.status != 200:
            raise _refusal(answer.status, found)
        return found

    def _connect(self) -> http.client.HTTPConnection:
        if self.tls is None:
            return http.client.HTTPConnection(self.host, self.port, timeout=self.timeout)
        return http.client.HTTPSConnection(self.host, self.port, timeout=self.timeout, context=self.tls)


def _refusal(status: int, answer: Any) -> Error:
    details = answer.get("details") or [answer.get("message", f"status {status}")]
    return _BY_STATUS.get(status, SystemFailure)("; ".join(details))
