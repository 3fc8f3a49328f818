// SPDX-License-Identifier: MIT
#include "net/tls.hpp"

#include <arpa/inet.h>
#include <array>
#include <climits>
#include <ctime>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include "net/addresses.hpp"

namespace tribo::net {
namespace {

struct Free {
    void operator()(BIO* p) const { BIO_free(p); }
    void operator()(X509* p) const { X509_free(p); }
    void operator()(EVP_PKEY* p) const { EVP_PKEY_free(p); }
    void operator()(GENERAL_NAMES* p) const { GENERAL_NAMES_free(p); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

constexpr const char* kRemake = "make both anew, with mkcert or 'openssl req -x509'";

// Returns the text of the last OpenSSL error.
std::string reason() {
    const unsigned long code = ERR_peek_last_error();
    ERR_clear_error();
    const char* words = code == 0 ? nullptr : ERR_reason_error_string(code);
    return words == nullptr ? "" : std::string(" (") + words + ")";
}

Owned<BIO> reader(const std::string& text) {
    // A longer text is not a valid PEM file.
    const int size = text.size() > INT_MAX ? 0 : static_cast<int>(text.size());
    return Owned<BIO>(BIO_new_mem_buf(text.data(), size));
}

// Never asks on the terminal. Records that a passphrase was required.
int no_passphrase(char*, int, int, void* asked) {
    *static_cast<bool*>(asked) = true;
    return -1;
}

std::string date_of(const ASN1_TIME* time) {
    tm parts{};
    std::array<char, 32> text{};
    if (ASN1_TIME_to_tm(time, &parts) != 1) return "an unknown date";
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &parts);
    return text.data();
}

std::vector<std::string> names_in(X509* certificate) {
    std::vector<std::string> names;
    const Owned<GENERAL_NAMES> listed(
        static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr)));
    for (int n = 0; listed && n < sk_GENERAL_NAME_num(listed.get()); ++n) {
        const GENERAL_NAME* name = sk_GENERAL_NAME_value(listed.get(), n);
        if (name->type == GEN_DNS) {
            const std::string text(reinterpret_cast<const char*>(ASN1_STRING_get0_data(name->d.dNSName)),
                                   static_cast<std::size_t>(ASN1_STRING_length(name->d.dNSName)));
            if (text.find('*') == std::string::npos) names.push_back(in_lower_case(text));
        } else if (name->type == GEN_IPADD) {
            std::array<char, INET6_ADDRSTRLEN> text{};
            const int family = ASN1_STRING_length(name->d.iPAddress) == 4 ? AF_INET : AF_INET6;
            if (::inet_ntop(family, ASN1_STRING_get0_data(name->d.iPAddress), text.data(), text.size()))
                names.emplace_back(text.data());
        }
    }
    return names;
}

Result<void> check_dates(X509* certificate, const std::string& file) {
    const ASN1_TIME* first = X509_get0_notBefore(certificate);
    const ASN1_TIME* last = X509_get0_notAfter(certificate);
    if (X509_cmp_current_time(last) < 0)
        return fail_at(file, 0, 0, "the certificate expired on " + date_of(last), kRemake);
    if (X509_cmp_current_time(first) > 0)
        return fail_at(file, 0, 0, "the certificate is not valid before " + date_of(first),
                       "set this machine's clock, or make the certificate anew");
    return {};
}

Result<Owned<X509>> use_certificates(SSL_CTX* context, const TlsKeys& keys) {
    const std::string& file = keys.certificate_file;
    const Owned<BIO> text = reader(keys.certificate_pem);
    Owned<X509> own(PEM_read_bio_X509_AUX(text.get(), nullptr, nullptr, nullptr));
    if (!own) {
        const bool swapped = keys.certificate_pem.find("PRIVATE KEY-----") != std::string::npos;
        return fail_at(
            file, 0, 0, swapped ? "holds a key, not a certificate" : "holds no certificate in PEM" + reason(),
            swapped ? "give the key with --tls-key" : "give the file that begins with BEGIN CERTIFICATE");
    }
    if (auto valid = check_dates(own.get(), file); !valid) return std::unexpected(valid.error());
    if (SSL_CTX_use_certificate(context, own.get()) != 1)
        return fail_at(file, 0, 0, "the certificate cannot be used" + reason(), kRemake);
    while (const Owned<X509> next{PEM_read_bio_X509(text.get(), nullptr, nullptr, nullptr)}) {
        if (SSL_CTX_add1_chain_cert(context, next.get()) != 1)
            return fail_at(file, 0, 0, "a certificate of the chain cannot be used" + reason(), kRemake);
    }
    ERR_clear_error();  // removes the error "no further certificate"
    return own;
}

Result<void> use_key(SSL_CTX* context, X509* certificate, const TlsKeys& keys) {
    const std::string& file = keys.key_file;
    bool locked = false;
    const Owned<BIO> text = reader(keys.key_pem);
    const Owned<EVP_PKEY> key(PEM_read_bio_PrivateKey(text.get(), nullptr, no_passphrase, &locked));
    if (locked)
        return fail_at(file, 0, 0, "the key is locked with a passphrase",
                       "unlock a copy: openssl pkey -in " + file + " -out FILE");
    if (!key)
        return fail_at(file, 0, 0, "holds no private key in PEM" + reason(),
                       "give the file that begins with BEGIN PRIVATE KEY");
    if (X509_check_private_key(certificate, key.get()) != 1) {
        ERR_clear_error();
        return fail_at(file, 0, 0,
                       "the key is not that of the certificate in '" + keys.certificate_file + "'",
                       "give the two that were made together");
    }
    if (SSL_CTX_use_PrivateKey(context, key.get()) != 1)
        return fail_at(file, 0, 0, "the key cannot be used" + reason(), kRemake);
    return {};
}

}  // namespace

Result<TlsContext> make_tls_context(const TlsKeys& keys) {
    ERR_clear_error();
    const std::shared_ptr<SSL_CTX> context(SSL_CTX_new(TLS_server_method()), [](SSL_CTX* p) {
        if (p != nullptr) SSL_CTX_free(p);
    });
    if (!context || SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION) != 1)
        return fail("OpenSSL gives no TLS" + reason(), "look into its configuration (openssl.cnf)");
    SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION);
    auto certificate = use_certificates(context.get(), keys);
    if (!certificate) return std::unexpected(certificate.error());
    if (auto used = use_key(context.get(), certificate->get(), keys); !used)
        return std::unexpected(used.error());
    return TlsContext{context, names_in(certificate->get())};
}

}  // namespace tribo::net
