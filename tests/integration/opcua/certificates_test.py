#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop-opcua on an address that other hosts can reach: only encrypted connections, only clients that are trusted, a
certificate of the plant's authority. In a network namespace of its own. certificates_test.py PROGRAMS FAKE_NODE [TEST...]"""

import pathlib
import subprocess

from opcua_harness import Client, enter_namespace, Failed, main, refused, wait_for
from users_test import PASSWORD, user, Users

PLANT = '<plant name="press"><board name="here"/></plant>'


def begin(setting, *options):
    setting.start_node()
    server = setting.start_server("--write", "--users", Users(setting, anna=user("operate")).file)
    return setting.start_opcua(server, "--bind", "0.0.0.0", "--host", "127.0.0.1", "--anonymous", *options)


def is_watched(process, folder):
    """Whether a process is notified of changes in a folder."""
    inode = f" ino:{folder.stat().st_ino:x} "
    return any(inode in info.read_text() for info in pathlib.Path(f"/proc/{process.pid}/fdinfo").iterdir() if info.exists())


def rejected_certificates(setting, pki):
    """Those that the server has written to their end, once it notices where they are moved. Before that, as long as it
    starts, they would not be recognized."""
    wait_for(lambda: is_watched(setting.opcua, pki / "trusted/certs"), "the server to watch the trusted certificates")
    return wait_for(lambda: [one for one in (pki / "rejected").iterdir() if one.read_text().rstrip().endswith("-----END CERTIFICATE-----")],
                    "the rejected certificate")


def connect_when_trusted(client, **words):
    """The server reads the folder of trusted certificates again some time after it has changed."""
    def connected():
        try:
            client.connect(**words)
            return True
        except Failed:
            return False
    wait_for(connected, "the connection of a client that is trusted")


def test_clients_are_trusted_one_by_one(setting):
    endpoint = begin(setting)
    client = Client(setting, endpoint)
    offered = client.do("endpoints", url=endpoint)
    assert {(one["mode"], one["policy"]) for one in offered} == {
        ("SignAndEncrypt", "Basic256Sha256"), ("SignAndEncrypt", "Aes128_Sha256_RsaOaep")}, offered
    assert {kind for one in offered for kind in one["users"]} == {"Anonymous", "UserName"}, offered
    refused(lambda: client.connect())
    words = {"user": "anna", "password": PASSWORD, "mode": "SignAndEncrypt", "policy": "Aes128_Sha256_RsaOaep"}
    refused(lambda: client.connect(**words))
    pki = setting.folder / "opcua/pki"
    rejected = rejected_certificates(setting, pki)
    assert len(rejected) == 1, rejected
    rejected[0].rename(pki / "trusted/certs" / rejected[0].name)
    again = Client(setting, endpoint)
    connect_when_trusted(again, **words)
    assert again.read(setting.id("knu::Robot::gain"))["code"] == "Good"
    assert (pki.stat().st_mode & 0o077) == 0, "private keys are the owner's"


def test_a_certificate_of_the_plant(setting):
    (setting.folder / "plant.xml").write_text(PLANT)
    keys = setting.folder / "keys"
    run = lambda *words: subprocess.run([setting.programs / "indurop", "keys", *words, "--dir", keys], check=True,
                                        cwd=setting.folder, capture_output=True)
    run("init", "plant.xml")
    run("server", "door", "--host", "127.0.0.1", "cell.local", "--opcua")
    made = keys / "servers/door"
    endpoint = begin(setting, "--cert", made / "server.pem", "--key", made / "server.key")
    client = Client(setting, endpoint)
    words = {"user": "anna", "password": PASSWORD, "mode": "SignAndEncrypt", "policy": "Basic256Sha256",
             "ca": str(keys / "ca.pem"), "revoked": str(keys / "revoked.pem")}
    refused(lambda: client.connect(**words))
    pki = setting.folder / "opcua/pki"
    for one in rejected_certificates(setting, pki):
        one.rename(pki / "trusted/certs" / one.name)
    connect_when_trusted(client, **words)
    assert client.read(setting.id("knu::Robot::gain"))["code"] == "Good"


if __name__ == "__main__":
    enter_namespace()
    main(globals())
