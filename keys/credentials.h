// SPDX-License-Identifier: Apache-2.0
// Keys, certificates and signed documents as PEM and S/MIME text, made and examined with libcrypto. No files here. What
// makes something returns nothing if libcrypto could not; crypto_problem() says why.

#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace indurop::keys {

using Instant = std::chrono::sys_seconds;  // of UTC

enum class KeyKind { P256, Ed25519 };

// Who a certificate is for. `unit` may be empty.
struct Identity {
  std::string organisation;
  std::string unit;
  std::string common_name;
};

struct Validity {
  Instant from;
  Instant until;
};

// An authority's certificate with its private key.
struct Authority {
  std::string certificate;
  std::string key;
};

struct CertificateFacts {
  std::string subject;  // "CN=sensor,O=cell", as documents of DDS Security name it
  std::string organisation;
  std::string common_name;
  std::string serial;  // hexadecimal
  Validity validity;
  std::string unit;
  Identity issuer;
};

// Private key; secret.
std::string make_key(KeyKind kind);
std::string public_half(const std::string& key);

std::string make_authority(const std::string& key, const Identity& identity, const Validity& validity);
// For the owner of `key`. It can neither issue certificates nor sign documents.
std::string make_certificate(const Authority& authority, const std::string& key, const Identity& identity,
                             const Validity& validity);
// Of certificates with these serial numbers, besides those of `before`, which may be empty.
std::string make_revocation_list(const Authority& authority, const std::string& before,
                                 const std::vector<std::string>& serials, const Validity& validity);
// S/MIME with the text readable in it, as DDS Security wants it.
std::string sign_document(const Authority& authority, const std::string& text);

// SHA-256 of the subject a certificate of this identity has, hexadecimal. Participants of DDS Security are numbered by
// it.
std::string subject_digest(const Identity& identity);

std::optional<CertificateFacts> read_certificate(const std::string& certificate);
bool issued_by(const std::string& certificate, const std::string& authority);
bool belongs_to(const std::string& certificate, const std::string& key);
bool is_revoked(const std::string& certificate, const std::string& revocation_list);
// Is it a list that this authority signed?
bool revocation_list_of(const std::string& revocation_list, const std::string& authority);
// The text of a document of sign_document(); empty if this authority did not sign it as it is.
std::string signed_text(const std::string& document, const std::string& authority);

// Ed25519 signature as text of hexadecimal digits.
std::string signature_of(const std::string& text, const std::string& key);
bool signature_holds(const std::string& text, const std::string& signature, const std::string& public_key);

std::string crypto_problem();

// "2036-11-18T09:10:00Z"
std::string utc_text(Instant instant);

}  // namespace indurop::keys
