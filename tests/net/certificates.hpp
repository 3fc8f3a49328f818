// SPDX-License-Identifier: MIT
// Certificates and keys made on the spot, good ones and bad ones.
#pragma once

#include <memory>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <string>

namespace tribo::net::test {

struct PemPair {
    std::string certificate, key;
};

inline std::string text_of(BIO* bio) {
    char* data = nullptr;
    const long size = BIO_get_mem_data(bio, &data);
    std::string text(data, static_cast<std::size_t>(size));
    BIO_free(bio);
    return text;
}

// Signed by itself, valid from `from_days` to `to_days` from now, for `names` as OpenSSL writes them
// ("DNS:localhost,IP:127.0.0.1"); the key locked where a passphrase is given.
inline PemPair make_certificate(const char* names = "DNS:localhost,IP:127.0.0.1", long from_days = -1,
                                long to_days = 30, const std::string& passphrase = {}) {
    const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(EVP_EC_gen("P-256"), &EVP_PKEY_free);
    const std::unique_ptr<X509, decltype(&X509_free)> certificate(X509_new(), &X509_free);
    X509* c = certificate.get();
    X509_set_version(c, 2);
    ASN1_INTEGER_set(X509_get_serialNumber(c), 1);
    constexpr long kDayS = 24 * 3600;
    X509_gmtime_adj(X509_getm_notBefore(c), from_days * kDayS);
    X509_gmtime_adj(X509_getm_notAfter(c), to_days * kDayS);
    X509_set_pubkey(c, key.get());
    X509_NAME_add_entry_by_txt(X509_get_subject_name(c), "CN", MBSTRING_ASC,
                               reinterpret_cast<const unsigned char*>("test"), -1, -1, 0);
    X509_set_issuer_name(c, X509_get_subject_name(c));
    X509_EXTENSION* extension = X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, names);
    X509_add_ext(c, extension, -1);
    X509_EXTENSION_free(extension);
    X509_sign(c, key.get(), EVP_sha256());
    BIO* out = BIO_new(BIO_s_mem());
    PEM_write_bio_X509(out, c);
    BIO* key_out = BIO_new(BIO_s_mem());
    PEM_write_bio_PrivateKey(key_out, key.get(), passphrase.empty() ? nullptr : EVP_aes_128_cbc(),
                             reinterpret_cast<const unsigned char*>(passphrase.data()),
                             static_cast<int>(passphrase.size()), nullptr, nullptr);
    return {text_of(out), text_of(key_out)};
}

}  // namespace tribo::net::test
