#include "gateway/checks/identity_check.hpp"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::gateway::checks {

namespace {

using error::Expected;

constexpr std::size_t kMaxFile_bytes = std::size_t{1} << 20;

template <auto release>
struct Release {
  template <class Object>
  void operator()(Object* object) const {
    release(object);
  }
};
using Bio = std::unique_ptr<BIO, Release<BIO_free_all>>;
using Certificate = std::unique_ptr<X509, Release<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Release<EVP_PKEY_free>>;
using Store = std::unique_ptr<X509_STORE, Release<X509_STORE_free>>;
using StoreContext = std::unique_ptr<X509_STORE_CTX, Release<X509_STORE_CTX_free>>;
using SignedDocument = std::unique_ptr<PKCS7, Release<PKCS7_free>>;

Bio bio_of(const std::string& text) {
  return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

// Everything that has been written into a memory BIO.
std::string text_in(const Bio& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return size > 0 ? std::string(data, static_cast<std::size_t>(size)) : std::string();
}

// Reason of the last failed call of OpenSSL.
std::string openssl_reason() {
  const unsigned long code = ERR_peek_last_error();
  const char* reason = code == 0 ? nullptr : ERR_reason_error_string(code);
  ERR_clear_error();
  return reason == nullptr ? "something else" : reason;
}

tl::unexpected<error::Error> fault(const std::string& expected, const std::string& found, const std::string& action) {
  return error::fail("Network: security", expected, found, action);
}

Expected<std::string> text_of_file(const std::filesystem::path& path) {
  constexpr const char* kMake = "scripts/network_identities makes the folder of a host";
  struct stat status{};
  if (::stat(path.c_str(), &status) != 0) return fault("the file " + path.string(), error::reason_of(errno), kMake);
  if (!S_ISREG(status.st_mode))
    return fault("a regular file " + path.string(),
                 S_ISDIR(status.st_mode) ? "a folder" : "a pipe, a socket or a device", kMake);
  auto text = file::read_regular_file(path, kMaxFile_bytes + 1);
  if (!text)
    return fault("a file that can be read", path.string() + ": " + error::reason_of(errno), "check its permissions");
  if (text->empty() || text->size() > kMaxFile_bytes)
    return fault("1 to " + std::to_string(kMaxFile_bytes) + " bytes in " + path.string(),
                 text->empty() ? "none" : "more", kMake);
  return std::move(*text);
}

Expected<Certificate> certificate_in(const std::filesystem::path& path) {
  const auto text = text_of_file(path);
  if (!text) return tl::unexpected(text.error());
  Certificate certificate(PEM_read_bio_X509(bio_of(*text).get(), nullptr, nullptr, nullptr));
  if (!certificate)
    return fault("a certificate in the form PEM in " + path.string(), openssl_reason(), "copy the host's folder again");
  return certificate;
}

// A key with a password is refused: nobody is asked for it.
Expected<Key> key_in(const std::filesystem::path& path) {
  const auto text = text_of_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto no_password = [](char*, int, int, void*) { return -1; };
  Key key(PEM_read_bio_PrivateKey(bio_of(*text).get(), nullptr, no_password, nullptr));
  if (!key)
    return fault("a private key without password in the form PEM in " + path.string(), openssl_reason(),
                 "copy the host's folder again");
  return key;
}

std::string subject_of(const X509* certificate) {
  const Bio out(BIO_new(BIO_s_mem()));
  X509_NAME_print_ex(out.get(), X509_get_subject_name(certificate), 0, XN_FLAG_RFC2253);
  return text_in(out);
}

std::string time_text(const ASN1_TIME* time) {
  const Bio out(BIO_new(BIO_s_mem()));
  ASN1_TIME_print(out.get(), time);
  return text_in(out);
}

Store store_with(X509* authority) {
  Store store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), authority);
  return store;
}

Expected<void> check_certificate(const std::filesystem::path& path, X509* certificate, X509* authority) {
  if (X509_cmp_current_time(X509_get0_notAfter(certificate)) < 0)
    return fault("a certificate that is valid now in " + path.string(),
                 "one until " + time_text(X509_get0_notAfter(certificate)),
                 "check this computer's date, or make the identities again");
  if (X509_cmp_current_time(X509_get0_notBefore(certificate)) > 0)
    return fault("a certificate that is valid now in " + path.string(),
                 "one from " + time_text(X509_get0_notBefore(certificate)) + " on", "check this computer's date");
  const Store store = store_with(authority);
  const StoreContext context(X509_STORE_CTX_new());
  X509_STORE_CTX_init(context.get(), store.get(), certificate, nullptr);
  if (X509_verify_cert(context.get()) == 1) return {};
  ERR_clear_error();
  return fault("a certificate that identity_ca.pem beside it has signed in " + path.string(),
               X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get())),
               "copy all files of the host's folder from one run of scripts/network_identities");
}

// The text of a signed document (S/MIME).
Expected<std::string> signed_text(const std::filesystem::path& path, X509* authority) {
  const auto text = text_of_file(path);
  if (!text) return tl::unexpected(text.error());
  BIO* content = nullptr;
  const SignedDocument document(SMIME_read_PKCS7(bio_of(*text).get(), &content));
  const Bio owned(content);
  constexpr const char* kAction = "copy all files of the host's folder from one run of scripts/network_identities";
  if (!document) return fault("a signed document (S/MIME) in " + path.string(), openssl_reason(), kAction);
  const Bio out(BIO_new(BIO_s_mem()));
  const Store store = store_with(authority);
  if (PKCS7_verify(document.get(), nullptr, store.get(), content, out.get(), 0) != 1)
    return fault("a document that permissions_ca.pem beside it has signed in " + path.string(), openssl_reason(),
                 kAction);
  return text_in(out);
}

// The parts of a subject, such as CN=a, in a fixed order: documents write them in either order.
std::vector<std::string> parts_of(std::string_view subject) {
  std::vector<std::string> parts;
  for (const std::string_view part : text::fields_of(subject, ','))
    if (!part.empty()) parts.emplace_back(part);
  std::ranges::sort(parts);
  return parts;
}

// Subjects of the grants in a document of permissions.
std::vector<std::string> granted_subjects(std::string_view document) {
  constexpr std::string_view kBegin = "<subject_name>", kEnd = "</subject_name>";
  std::vector<std::string> subjects;
  for (std::size_t at = document.find(kBegin); at != std::string_view::npos; at = document.find(kBegin, at)) {
    at += kBegin.size();
    const std::size_t end = document.find(kEnd, at);
    if (end == std::string_view::npos) break;
    subjects.emplace_back(text::trimmed(document.substr(at, end - at)));
  }
  return subjects;
}

Expected<void> check_permissions(const std::filesystem::path& path, const X509* certificate, X509* authority) {
  const auto document = signed_text(path, authority);
  if (!document) return tl::unexpected(document.error());
  const std::string subject = subject_of(certificate);
  const auto granted = granted_subjects(*document);
  if (std::ranges::any_of(granted, [&](const auto& name) { return parts_of(name) == parts_of(subject); })) return {};
  constexpr std::size_t kShown = 8, kShownLength = 64;
  std::string found;
  for (std::size_t i = 0; i < std::min(granted.size(), kShown); ++i)
    found += (i == 0 ? "" : "; ") + granted[i].substr(0, kShownLength);
  return fault("permissions of " + subject + ", which certificate.pem is of, in " + path.string(),
               found.empty() ? "those of nobody" : "those of " + found, "copy this host's own folder, and all of it");
}

// A line if others than the owner can read or write the key.
std::vector<std::string> warnings_of_key(const std::filesystem::path& path) {
  struct stat status{};
  if (::stat(path.c_str(), &status) != 0 || (status.st_mode & 077U) == 0) return {};
  std::array<char, 8> mode{};
  std::snprintf(mode.data(), mode.size(), "%04o", static_cast<unsigned>(status.st_mode & 07777U));
  return {"Network: security: expected a private key that its user alone can read, found mode " +
          std::string(mode.data()) + "; chmod 600 " + path.string()};
}

}  // namespace

Expected<std::vector<std::string>> check_identity(const std::string& folder, const std::string& name) {
  const std::filesystem::path path(folder);
  struct stat status{};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists || !S_ISDIR(status.st_mode))
    return fault("a folder with the identity of this host", exists ? folder + ", a file" : "none at " + folder,
                 "scripts/network_identities makes one for each host");
  const auto authority = certificate_in(path / "identity_ca.pem");
  if (!authority) return tl::unexpected(authority.error());
  const auto certificate = certificate_in(path / "certificate.pem");
  if (!certificate) return tl::unexpected(certificate.error());
  const std::string subject = subject_of(certificate->get());
  if (!name.empty() && subject != "CN=" + name)
    return fault("the certificate of host " + name + ", CN=" + name + ", in " + (path / "certificate.pem").string(),
                 subject, "give the form Network the `name` of the certificate, or copy this host's own folder");
  const auto key = key_in(path / "key.pem");
  if (!key) return tl::unexpected(key.error());
  if (auto checked = check_certificate(path / "certificate.pem", certificate->get(), authority->get()); !checked)
    return tl::unexpected(checked.error());
  if (X509_check_private_key(certificate->get(), key->get()) != 1) {
    ERR_clear_error();
    return fault("the key of certificate.pem (" + subject + ") in " + (path / "key.pem").string(), "another key",
                 "copy this host's own folder, and all of it");
  }
  const auto permissions_authority = certificate_in(path / "permissions_ca.pem");
  if (!permissions_authority) return tl::unexpected(permissions_authority.error());
  if (auto governance = signed_text(path / "governance.p7s", permissions_authority->get()); !governance)
    return tl::unexpected(governance.error());
  if (auto checked = check_permissions(path / "permissions.p7s", certificate->get(), permissions_authority->get());
      !checked)
    return tl::unexpected(checked.error());
  return warnings_of_key(path / "key.pem");
}

}  // namespace yars::gateway::checks
