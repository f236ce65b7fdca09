// SPDX-License-Identifier: Apache-2.0
#include "core/keys/revocation.h"

#include <algorithm>

#include "core/keys/openssl_objects.h"

namespace indurop::keys {
namespace {

bool add_revoked(X509_CRL* list, const std::string& serial, const ASN1_TIME* when) {
  BIGNUM* raw = nullptr;
  const bool is_number = ::BN_hex2bn(&raw, serial.c_str()) > 0;
  const Number number(raw);
  const Serial value(is_number ? ::BN_to_ASN1_INTEGER(number.get(), nullptr) : nullptr);
  Revoked entry(::X509_REVOKED_new());
  if (value == nullptr || entry == nullptr || ::X509_REVOKED_set_serialNumber(entry.get(), value.get()) != 1 ||
      ::X509_REVOKED_set_revocationDate(entry.get(), const_cast<ASN1_TIME*>(when)) != 1 ||  // NOLINT: only copied
      ::X509_CRL_add0_revoked(list, entry.get()) != 1) {
    return false;
  }
  (void)entry.release();
  return true;
}

bool copy_revoked(X509_CRL* into, const std::string& before) {
  if (before.empty()) {
    return true;
  }
  const Crl old = read_crl(before);
  if (old == nullptr) {
    return false;
  }
  const STACK_OF(X509_REVOKED)* all = ::X509_CRL_get_REVOKED(old.get());
  for (int i = 0; i < sk_X509_REVOKED_num(all); ++i) {
    Revoked copy(::X509_REVOKED_dup(sk_X509_REVOKED_value(all, i)));
    if (copy == nullptr || ::X509_CRL_add0_revoked(into, copy.get()) != 1) {
      return false;
    }
    (void)copy.release();
  }
  return true;
}

}  // namespace

std::string make_revocation_list(const Authority& authority, const std::string& before,
                                 const std::vector<std::string>& serials, const Validity& validity) {
  constexpr long kVersion2 = 1;
  const Key signing = read_key(authority.key);
  const Cert issuer = read_cert(authority.certificate);
  const Crl made(::X509_CRL_new());
  const Time from = to_time(validity.from);
  const Time until = to_time(validity.until);
  const bool ok = signing != nullptr && issuer != nullptr && made != nullptr && from != nullptr && until != nullptr &&
                  ::X509_CRL_set_version(made.get(), kVersion2) == 1 &&
                  ::X509_CRL_set_issuer_name(made.get(), ::X509_get_subject_name(issuer.get())) == 1 &&
                  ::X509_CRL_set1_lastUpdate(made.get(), from.get()) == 1 &&
                  ::X509_CRL_set1_nextUpdate(made.get(), until.get()) == 1 && copy_revoked(made.get(), before) &&
                  std::all_of(serials.begin(), serials.end(),
                              [&](const std::string& serial) { return add_revoked(made.get(), serial, from.get()); }) &&
                  ::X509_CRL_sort(made.get()) == 1 && ::X509_CRL_sign(made.get(), signing.get(), ::EVP_sha256()) != 0;
  const Bio out = writing();
  return ok && ::PEM_write_bio_X509_CRL(out.get(), made.get()) == 1 ? content(out) : std::string{};
}

bool is_revoked(const std::string& certificate, const std::string& revocation_list) {
  const Cert read = read_cert(certificate);
  const Crl list = read_crl(revocation_list);
  X509_REVOKED* found = nullptr;
  return read != nullptr && list != nullptr && ::X509_CRL_get0_by_cert(list.get(), &found, read.get()) == 1;
}

bool revokes_all_of(const std::string& revocation_list, const std::string& before) {
  const Crl list = read_crl(revocation_list);
  const Crl old = read_crl(before);
  const STACK_OF(X509_REVOKED)* all = old == nullptr ? nullptr : ::X509_CRL_get_REVOKED(old.get());
  for (int i = 0; i < sk_X509_REVOKED_num(all); ++i) {
    const ASN1_INTEGER* serial = ::X509_REVOKED_get0_serialNumber(sk_X509_REVOKED_value(all, i));
    X509_REVOKED* found = nullptr;
    if (list == nullptr || ::X509_CRL_get0_by_serial(list.get(), &found, serial) != 1) {
      return false;
    }
  }
  return true;
}

bool revocation_list_of(const std::string& revocation_list, const std::string& authority) {
  const Crl list = read_crl(revocation_list);
  const Cert issuer = read_cert(authority);
  return list != nullptr && issuer != nullptr && ::X509_CRL_verify(list.get(), ::X509_get0_pubkey(issuer.get())) == 1;
}

}  // namespace indurop::keys
