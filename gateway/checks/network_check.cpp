#include "gateway/checks/network_check.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "lib/file/text_file.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::gateway::checks {

namespace {

using error::Expected;

using Address = std::uint32_t;  // IPv4, in the order of the host

struct Interface {
  std::string name;
  bool is_up = false;
  std::optional<Address> address, broadcast;
};

Address address_in(const sockaddr* socket) {
  return ntohl(reinterpret_cast<const sockaddr_in*>(socket)->sin_addr.s_addr);
}

std::string text_of(Address address) {
  const in_addr number{htonl(address)};
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &number, text.data(), text.size());
  return text.data();
}

// An interface has an entry for each of its addresses, of any kind. Those with an IPv4 address come first.
std::vector<Interface> interfaces_here() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, freeifaddrs);
  std::vector<Interface> here;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    Interface& found = here.emplace_back(Interface{entry->ifa_name, (entry->ifa_flags & IFF_UP) != 0, {}, {}});
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    found.address = address_in(entry->ifa_addr);
    if ((entry->ifa_flags & IFF_BROADCAST) == 0 || entry->ifa_netmask == nullptr) continue;
    // Of a network of four addresses or more. The system's own is 0 or the host's address where none is set.
    const Address last_host = ~address_in(entry->ifa_netmask);
    if (last_host >= 3) found.broadcast = *found.address | last_host;
  }
  std::stable_partition(here.begin(), here.end(), [](const Interface& one) { return one.address.has_value(); });
  return here;
}

// "eth0 (192.168.10.1), lo (127.0.0.1)": those that a gateway can use.
std::string list_of(const std::vector<Interface>& interfaces) {
  std::string list;
  for (const Interface& one : interfaces)
    if (one.is_up && one.address) list += (list.empty() ? "" : ", ") + one.name + " (" + text_of(*one.address) + ')';
  return list.empty() ? "none" : list;
}

Expected<void> check_interface(const std::string& name, const std::vector<Interface>& here) {
  const auto found = std::ranges::find(here, name, &Interface::name);
  if (found != here.end() && found->is_up && found->address) return {};
  std::string what = '"' + name + '"';
  if (found != here.end())
    what += !found->is_up ? ", which is down (ip link set " + name + " up)" : ", which has no IPv4 address";
  const auto addressed = std::ranges::find_if(
      here, [&name](const Interface& one) { return one.address && text_of(*one.address) == name; });
  return error::fail("Network: interfaces", "names of interfaces of this computer, which are " + list_of(here), what,
                     addressed != here.end() ? "did you mean \"" + addressed->name + "\"?" : "name one of them");
}

// IPv4 address of a peer, which is an address, or a name, or one of them with `:PORT`; nullopt: the name has none.
std::optional<Address> address_of(const std::string& peer) {
  const std::string host = peer.substr(0, peer.find(':'));
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0 || found == nullptr) return std::nullopt;
  const Address address = address_in(found->ai_addr);
  freeaddrinfo(found);
  return address;
}

// ---- Identity
constexpr std::size_t kMaxFile_bytes = std::size_t{1} << 20;
constexpr const char* kCopyAll = "copy all files of the host's folder from one run of scripts/network_identities";

template <auto release>
using Release = decltype([](auto* object) { release(object); });
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

// check_identity() returns what is thrown here.
[[noreturn]] void refuse(const std::string& expected, const std::string& found, const std::string& action) {
  throw error::Error{"Network: security", expected, found, action};
}

std::string text_of_file(const std::filesystem::path& path) {
  constexpr const char* kMake = "scripts/network_identities makes the folder of a host";
  struct stat status{};
  if (::stat(path.c_str(), &status) != 0) refuse("the file " + path.string(), error::reason_of(errno), kMake);
  if (!S_ISREG(status.st_mode))
    refuse("a regular file " + path.string(), S_ISDIR(status.st_mode) ? "a folder" : "a pipe, a socket or a device",
           kMake);
  auto text = file::read_regular_file(path, kMaxFile_bytes + 1);
  if (!text) refuse("a file that can be read", path.string() + ": " + error::reason_of(errno), "check its permissions");
  if (text->empty() || text->size() > kMaxFile_bytes)
    refuse("1 to " + std::to_string(kMaxFile_bytes) + " bytes in " + path.string(), text->empty() ? "none" : "more",
           kMake);
  return std::move(*text);
}

// The object in a file, by a function of OpenSSL. One with a password is refused: nobody is asked for it.
template <class Object, class Read>
Object pem_in(const std::filesystem::path& path, const std::string& what, const Read& read) {
  const std::string text = text_of_file(path);
  const auto no_password = [](char*, int, int, void*) { return -1; };
  Object object(read(bio_of(text).get(), nullptr, no_password, nullptr));
  if (!object) refuse(what + " in the form PEM in " + path.string(), openssl_reason(), "copy the host's folder again");
  return object;
}

Certificate certificate_in(const std::filesystem::path& path) {
  return pem_in<Certificate>(path, "a certificate", PEM_read_bio_X509);
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

void check_certificate(const std::filesystem::path& path, X509* certificate, X509* authority) {
  const bool has_ended = X509_cmp_current_time(X509_get0_notAfter(certificate)) < 0;
  if (has_ended || X509_cmp_current_time(X509_get0_notBefore(certificate)) > 0)
    refuse("a certificate that is valid now in " + path.string(),
           has_ended ? "one until " + time_text(X509_get0_notAfter(certificate))
                     : "one from " + time_text(X509_get0_notBefore(certificate)) + " on",
           "check this computer's date, or make the identities again");
  const Store store = store_with(authority);
  const StoreContext context(X509_STORE_CTX_new());
  X509_STORE_CTX_init(context.get(), store.get(), certificate, nullptr);
  if (X509_verify_cert(context.get()) == 1) return;
  ERR_clear_error();
  refuse("a certificate that identity_ca.pem beside it has signed in " + path.string(),
         X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get())), kCopyAll);
}

// The text of a signed document (S/MIME).
std::string signed_text(const std::filesystem::path& path, X509* authority) {
  const std::string text = text_of_file(path);
  BIO* content = nullptr;
  const SignedDocument document(SMIME_read_PKCS7(bio_of(text).get(), &content));
  const Bio owned(content);
  if (!document) refuse("a signed document (S/MIME) in " + path.string(), openssl_reason(), kCopyAll);
  const Bio out(BIO_new(BIO_s_mem()));
  const Store store = store_with(authority);
  if (PKCS7_verify(document.get(), nullptr, store.get(), content, out.get(), 0) != 1)
    refuse("a document that permissions_ca.pem beside it has signed in " + path.string(), openssl_reason(), kCopyAll);
  return text_in(out);
}

// The parts of a subject, such as CN=a. Documents write them in either order.
std::set<std::string_view> parts_of(std::string_view subject) {
  const auto parts = text::fields_of(subject, ',');
  return {parts.begin(), parts.end()};
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

void check_permissions(const std::filesystem::path& path, const std::string& subject, X509* authority) {
  std::string found;
  for (const std::string& granted : granted_subjects(signed_text(path, authority))) {
    if (parts_of(granted) == parts_of(subject)) return;
    found += (found.empty() ? "those of " : "; ") + granted;
  }
  refuse("permissions of " + subject + ", which certificate.pem is of, in " + path.string(),
         found.empty() ? "those of nobody" : text::shortened(found), "copy this host's own folder, and all of it");
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

std::string host_name() {
  std::array<char, 64> name{};
  gethostname(name.data(), name.size() - 1);
  const std::string_view text(name.data());
  return std::string(text.substr(0, std::min(text.find('.'), radar::kMaxHostName)));
}

Expected<ComputerCheck> check_computer(const radar::NetworkSettings& settings) {
  const std::vector<Interface> here = interfaces_here();
  for (const std::string& name : settings.interfaces)
    if (auto checked = check_interface(name, here); !checked) return tl::unexpected(checked.error());
  ComputerCheck check;
  for (const std::string& peer : settings.peers) {
    const auto address = address_of(peer);
    if (!address) {
      check.warnings.push_back("Network: peers: expected names that have an IPv4 address, found \"" + peer +
                               "\", which has none here; it is not asked: correct it, or write its address, and start "
                               "the gateway again");
      continue;
    }
    if (std::ranges::find(here, address, &Interface::broadcast) != here.end())
      return error::fail("Network: peers", "the address of each computer", peer + ", a broadcast address",
                         "list the computers one by one");
    check.known_peers.push_back(peer);
    if (*address >> 24U != 127 && std::ranges::find(here, address, &Interface::address) == here.end())
      check.other_peers.push_back(peer);
  }
  const bool reaches_others = std::ranges::any_of(settings.interfaces, [](const auto& name) { return name != "lo"; });
  if (!reaches_others && !check.other_peers.empty())
    check.warnings.emplace_back(
        "Network: interfaces: expected an interface that reaches the peers, found `lo` alone; name one that `ip link` "
        "lists");
  if (reaches_others && check.other_peers.empty() && check.known_peers.size() == settings.peers.size())
    check.warnings.emplace_back(
        "Network: peers: expected the addresses of the other computers, found none; this computer asks nobody, and "
        "joins those alone that name it: list them in `peers`");
  return check;
}

Expected<std::vector<std::string>> check_identity(const std::string& folder, const std::string& name) try {
  const std::filesystem::path path(folder);
  std::error_code code;
  if (!std::filesystem::is_directory(path, code))
    refuse("a folder with the identity of this host",
           std::filesystem::exists(path, code) ? folder + ", a file" : "none at " + folder,
           "scripts/network_identities makes one for each host");
  const Certificate authority = certificate_in(path / "identity_ca.pem");
  const Certificate certificate = certificate_in(path / "certificate.pem");
  const std::string subject = subject_of(certificate.get());
  if (!name.empty() && subject != "CN=" + name)
    refuse("the certificate of host " + name + ", CN=" + name + ", in " + (path / "certificate.pem").string(), subject,
           "give the form Network the `name` of the certificate, or copy this host's own folder");
  const Key key = pem_in<Key>(path / "key.pem", "a private key without password", PEM_read_bio_PrivateKey);
  check_certificate(path / "certificate.pem", certificate.get(), authority.get());
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    ERR_clear_error();
    refuse("the key of certificate.pem (" + subject + ") in " + (path / "key.pem").string(), "another key",
           "copy this host's own folder, and all of it");
  }
  const Certificate permissions_authority = certificate_in(path / "permissions_ca.pem");
  signed_text(path / "governance.p7s", permissions_authority.get());
  check_permissions(path / "permissions.p7s", subject, permissions_authority.get());
  return warnings_of_key(path / "key.pem");
} catch (const error::Error& fault) {
  return tl::unexpected(fault);
}

}  // namespace yars::gateway::checks
