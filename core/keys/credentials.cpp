// SPDX-License-Identifier: Apache-2.0
#include "core/keys/credentials.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>

#include "core/keys/openssl_objects.h"

namespace indurop::keys {
namespace {

Instant to_instant(const ASN1_TIME* time) {
  std::tm parts{};
  if (::ASN1_TIME_to_tm(time, &parts) != 1) {
    return {};
  }
  return std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::from_time_t(::timegm(&parts)));
}

bool add_entry(X509_NAME* name, const char* field, const std::string& value) {
  return value.empty() ||
         ::X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8, reinterpret_cast<const unsigned char*>(value.data()),
                                      static_cast<int>(value.size()), -1, 0) == 1;
}

bool add_extension(X509* certificate, X509* issuer, int kind, const char* value) {
  X509V3_CTX context{};
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const Extension extension(::X509V3_EXT_conf_nid(nullptr, &context, kind, value));
  return extension != nullptr && ::X509_add_ext(certificate, extension.get(), -1) == 1;
}

bool set_serial(X509* certificate) {
  std::uint64_t serial = 0;
  return ::RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial) == 1 &&
         ::ASN1_INTEGER_set_uint64(::X509_get_serialNumber(certificate), (serial >> 1U) | 1U) == 1;
}

bool name_it(X509_NAME* name, const Identity& identity) {
  return add_entry(name, "O", identity.organisation) && add_entry(name, "OU", identity.unit) &&
         add_entry(name, "CN", identity.common_name);
}

bool fill(X509* certificate, EVP_PKEY* key, const Identity& identity, const Validity& validity) {
  constexpr long kVersion3 = 2;
  const Time from = to_time(validity.from);
  const Time until = to_time(validity.until);
  return from != nullptr && until != nullptr && ::X509_set_version(certificate, kVersion3) == 1 &&
         set_serial(certificate) && ::X509_set1_notBefore(certificate, from.get()) == 1 &&
         ::X509_set1_notAfter(certificate, until.get()) == 1 && ::X509_set_pubkey(certificate, key) == 1 &&
         name_it(::X509_get_subject_name(certificate), identity);
}

std::string pem_of(X509* certificate) {
  const Bio out = writing();
  return ::PEM_write_bio_X509(out.get(), certificate) == 1 ? content(out) : std::string{};
}

std::string entry_of(const X509_NAME* name, int field) {
  const int at = ::X509_NAME_get_index_by_NID(name, field, -1);
  if (at < 0) {
    return {};
  }
  const ASN1_STRING* value = ::X509_NAME_ENTRY_get_data(::X509_NAME_get_entry(name, at));
  return {reinterpret_cast<const char*>(::ASN1_STRING_get0_data(value)),
          static_cast<std::size_t>(::ASN1_STRING_length(value))};
}

std::string hex(const unsigned char* bytes, std::size_t size) {
  std::string text;
  for (std::size_t i = 0; i < size; ++i) {
    text += fmt::format("{:02x}", bytes[i]);
  }
  return text;
}

// `names`: value of the extension subjectAltName; empty: the certificate has none.
std::string issue(const Authority& authority, const std::string& key, const Identity& identity,
                  const Validity& validity, const char* extended, const std::string& names,
                  const char* usage = "critical,digitalSignature") {
  const Key own = read_key(key);
  const Key signing = read_key(authority.key);
  const Cert issuer = read_cert(authority.certificate);
  const Cert made(::X509_new());
  const bool ok = own != nullptr && signing != nullptr && issuer != nullptr && made != nullptr &&
                  fill(made.get(), own.get(), identity, validity) &&
                  ::X509_set_issuer_name(made.get(), ::X509_get_subject_name(issuer.get())) == 1 &&
                  add_extension(made.get(), issuer.get(), NID_basic_constraints, "critical,CA:FALSE") &&
                  add_extension(made.get(), issuer.get(), NID_key_usage, usage) &&
                  add_extension(made.get(), issuer.get(), NID_ext_key_usage, extended) &&
                  (names.empty() || add_extension(made.get(), issuer.get(), NID_subject_alt_name, names.c_str())) &&
                  add_extension(made.get(), issuer.get(), NID_authority_key_identifier, "keyid") &&
                  ::X509_sign(made.get(), signing.get(), ::EVP_sha256()) != 0;
  return ok ? pem_of(made.get()) : std::string{};
}

}  // namespace

std::string make_key(KeyKind kind) {
  constexpr unsigned int kRsaBits = 2048;
  const Key key(kind == KeyKind::P256      ? ::EVP_EC_gen("P-256")
                : kind == KeyKind::Rsa2048 ? ::EVP_RSA_gen(kRsaBits)
                                           : ::EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519"));
  const Bio out = writing();
  return key != nullptr &&
                 ::PEM_write_bio_PKCS8PrivateKey(out.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) == 1
             ? content(out)
             : std::string{};
}

std::string public_half(const std::string& key) {
  const Key both = read_key(key);
  const Bio out = writing();
  return both != nullptr && ::PEM_write_bio_PUBKEY(out.get(), both.get()) == 1 ? content(out) : std::string{};
}

std::string subject_digest(const Identity& identity) {
  const std::unique_ptr<X509_NAME, void (*)(X509_NAME*)> name(::X509_NAME_new(), &::X509_NAME_free);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  const bool ok = name != nullptr && name_it(name.get(), identity) &&
                  ::X509_NAME_digest(name.get(), ::EVP_sha256(), digest.data(), &size) == 1;
  return ok ? hex(digest.data(), size) : std::string{};
}

std::string make_authority(const std::string& key, const Identity& identity, const Validity& validity) {
  const Key own = read_key(key);
  const Cert made(::X509_new());
  const bool ok =
      own != nullptr && made != nullptr && fill(made.get(), own.get(), identity, validity) &&
      ::X509_set_issuer_name(made.get(), ::X509_get_subject_name(made.get())) == 1 &&
      add_extension(made.get(), made.get(), NID_basic_constraints, "critical,CA:TRUE,pathlen:0") &&
      add_extension(made.get(), made.get(), NID_key_usage, "critical,digitalSignature,keyCertSign,cRLSign") &&
      add_extension(made.get(), made.get(), NID_subject_key_identifier, "hash") &&
      ::X509_sign(made.get(), own.get(), ::EVP_sha256()) != 0;
  return ok ? pem_of(made.get()) : std::string{};
}

std::string make_certificate(const Authority& authority, const std::string& key, const Identity& identity,
                             const Validity& validity) {
  // Not for mail: a document signed with it is none of DDS Security's.
  return issue(authority, key, identity, validity, "serverAuth,clientAuth", {});
}

std::string make_server_certificate(const Authority& authority, const std::string& key, const Identity& identity,
                                    const std::string& names, const Validity& validity) {
  return issue(authority, key, identity, validity, "serverAuth", names);
}

std::string make_opcua_certificate(const Authority& authority, const std::string& key, const Identity& identity,
                                   const std::string& names, const Validity& validity) {
  return issue(authority, key, identity, validity, "serverAuth,clientAuth", names,
               "critical,digitalSignature,nonRepudiation,keyEncipherment,dataEncipherment");
}

std::string sign_document(const Authority& authority, const std::string& text) {
  constexpr int kFlags = PKCS7_DETACHED | PKCS7_TEXT;
  const Key signing = read_key(authority.key);
  const Cert signer = read_cert(authority.certificate);
  if (signing == nullptr || signer == nullptr) {
    return {};
  }
  const Pkcs7 made(::PKCS7_sign(signer.get(), signing.get(), nullptr, reading(text).get(), kFlags));
  const Bio out = writing();
  return made != nullptr && ::SMIME_write_PKCS7(out.get(), made.get(), reading(text).get(), kFlags) == 1
             ? content(out)
             : std::string{};
}

std::optional<CertificateFacts> read_certificate(const std::string& certificate) {
  const Cert read = read_cert(certificate);
  if (read == nullptr) {
    return std::nullopt;
  }
  const Bio subject = writing();
  ::X509_NAME_print_ex(subject.get(), ::X509_get_subject_name(read.get()), 0, XN_FLAG_RFC2253);
  const Number serial(::ASN1_INTEGER_to_BN(::X509_get0_serialNumber(read.get()), nullptr));
  const std::unique_ptr<char, void (*)(char*)> digits(::BN_bn2hex(serial.get()), [](char* p) { OPENSSL_free(p); });
  const X509_NAME* const name = ::X509_get_subject_name(read.get());
  const X509_NAME* const issuer = ::X509_get_issuer_name(read.get());
  return CertificateFacts{content(subject),
                          entry_of(name, NID_organizationName),
                          entry_of(name, NID_commonName),
                          digits == nullptr ? std::string{} : digits.get(),
                          {to_instant(::X509_get0_notBefore(read.get())), to_instant(::X509_get0_notAfter(read.get()))},
                          entry_of(name, NID_organizationalUnitName),
                          {entry_of(issuer, NID_organizationName), entry_of(issuer, NID_organizationalUnitName),
                           entry_of(issuer, NID_commonName)}};
}

bool issued_by(const std::string& certificate, const std::string& authority) {
  const Cert read = read_cert(certificate);
  const Cert issuer = read_cert(authority);
  return read != nullptr && issuer != nullptr && ::X509_verify(read.get(), ::X509_get0_pubkey(issuer.get())) == 1;
}

std::string public_key_in(const std::string& certificate) {
  const Cert read = read_cert(certificate);
  EVP_PKEY* const key = read == nullptr ? nullptr : ::X509_get0_pubkey(read.get());
  const Bio out = writing();
  return key != nullptr && ::PEM_write_bio_PUBKEY(out.get(), key) == 1 ? content(out) : std::string{};
}

bool belongs_to(const std::string& certificate, const std::string& key) {
  const Cert read = read_cert(certificate);
  const Key own = read_key(key);
  return read != nullptr && own != nullptr && ::X509_check_private_key(read.get(), own.get()) == 1;
}

std::string signed_text(const std::string& document, const std::string& authority) {
  BIO* raw = nullptr;
  const Pkcs7 read(::SMIME_read_PKCS7(reading(document).get(), &raw));
  const Bio detached(raw);
  const Cert issuer = read_cert(authority);
  if (read == nullptr || issuer == nullptr) {
    return {};
  }
  STACK_OF(X509)* signers = sk_X509_new_null();
  sk_X509_push(signers, issuer.get());
  const Bio out = writing();
  const bool ok = ::PKCS7_verify(read.get(), signers, nullptr, detached.get(), out.get(),
                                 PKCS7_TEXT | PKCS7_NOVERIFY | PKCS7_NOINTERN) == 1;
  sk_X509_free(signers);
  return ok ? content(out) : std::string{};
}

std::string signature_of(const std::string& text, const std::string& key) {
  const Key own = read_key(key);
  const Context context(::EVP_MD_CTX_new());
  std::array<unsigned char, 128> bytes{};
  std::size_t size = bytes.size();
  const bool ok = own != nullptr && context != nullptr &&
                  ::EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, own.get()) == 1 &&
                  ::EVP_DigestSign(context.get(), bytes.data(), &size,
                                   reinterpret_cast<const unsigned char*>(text.data()), text.size()) == 1;
  return ok ? hex(bytes.data(), size) : std::string{};
}

bool signature_holds(const std::string& text, const std::string& signature, const std::string& public_key) {
  const Key key(::PEM_read_bio_PUBKEY(reading(public_key).get(), nullptr, &no_password, nullptr));
  const Context context(::EVP_MD_CTX_new());
  long size = 0;
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> bytes(::OPENSSL_hexstr2buf(signature.c_str(), &size),
                                                                       [](unsigned char* p) { OPENSSL_free(p); });
  return key != nullptr && context != nullptr && bytes != nullptr &&
         ::EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key.get()) == 1 &&
         ::EVP_DigestVerify(context.get(), bytes.get(), static_cast<std::size_t>(size),
                            reinterpret_cast<const unsigned char*>(text.data()), text.size()) == 1;
}

std::string crypto_problem() {
  constexpr std::size_t kLongest = 256;
  const unsigned long code = ::ERR_get_error();
  if (code == 0) {
    return "libcrypto failed";
  }
  std::array<char, kLongest> text{};
  ::ERR_error_string_n(code, text.data(), text.size());
  ::ERR_clear_error();
  return std::string("libcrypto: ") + text.data();
}

std::string utc_text(Instant instant) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(instant)));
}

}  // namespace indurop::keys
