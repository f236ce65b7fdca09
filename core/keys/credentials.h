// SPDX-License-Identifier: Apache-2.0
// Creates and examines keys, certificates and signed documents as PEM and S/MIME text with libcrypto. Accesses no
// files. Functions that create something return an empty text if libcrypto failed; crypto_problem() then returns the
// reason.

#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace indurop::keys {

using Instant = std::chrono::sys_seconds;  // UTC

enum class KeyKind { P256, Ed25519, Rsa2048 };

// The holder of a certificate. `unit` may be empty.
struct Identity {
  std::string organisation;
  std::string unit;
  std::string common_name;
};

struct Validity {
  Instant from;
  Instant until;
};

// An authority's certificate and its private key.
struct Authority {
  std::string certificate;
  std::string key;
};

struct CertificateFacts {
  std::string subject;  // "CN=sensor,O=cell", as in documents of DDS Security
  std::string organisation;
  std::string common_name;
  std::string serial;  // hexadecimal
  Validity validity;
  std::string unit;
  Identity issuer;
};

// Returns a private key, which is secret.
std::string make_key(KeyKind kind);
std::string public_half(const std::string& key);

std::string make_authority(const std::string& key, const Identity& identity, const Validity& validity);
// Makes a certificate for the owner of `key`. It can neither issue certificates nor sign documents.
std::string make_certificate(const Authority& authority, const std::string& key, const Identity& identity,
                             const Validity& validity);
// Makes a certificate with which the owner of `key` can be a TLS server, and nothing else. `names`: as in the extension
// subjectAltName, "IP:192.168.1.5,DNS:cell.local".
std::string make_server_certificate(const Authority& authority, const std::string& key, const Identity& identity,
                                    const std::string& names, const Validity& validity);
// Makes a certificate of an OPC UA server (OPC 10000-6, 6.2.2) for `key`, which is RSA. `names` has its application
// URI, "URI:urn:indurop:opcua:cell.local", too.
std::string make_opcua_certificate(const Authority& authority, const std::string& key, const Identity& identity,
                                   const std::string& names, const Validity& validity);
// Returns S/MIME with the text readable in it, as DDS Security requires.
std::string sign_document(const Authority& authority, const std::string& text);

// Returns the SHA-256 of the subject of this identity's certificate, hexadecimal. GUIDs of DDS Security participants
// begin with it.
std::string subject_digest(const Identity& identity);

std::optional<CertificateFacts> read_certificate(const std::string& certificate);
bool issued_by(const std::string& certificate, const std::string& authority);
// Returns the public key of a certificate as PEM.
std::string public_key_in(const std::string& certificate);
bool belongs_to(const std::string& certificate, const std::string& key);
// Returns the text of a document made by sign_document(); empty if this authority did not sign exactly this document.
std::string signed_text(const std::string& document, const std::string& authority);

// Returns the signature by an Ed25519 or P-256 key as hexadecimal digits.
std::string signature_of(const std::string& text, const std::string& key);
bool signature_holds(const std::string& text, const std::string& signature, const std::string& public_key);

std::string crypto_problem();

// "2036-11-18T09:10:00Z"
std::string utc_text(Instant instant);

}  // namespace indurop::keys
