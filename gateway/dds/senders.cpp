#include "gateway/dds/senders.hpp"

#include <dds/dds.h>
#include <openssl/sha.h>
#include <openssl/x509.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "gateway/host_id.hpp"

namespace yars::gateway::dds {

namespace {

constexpr std::size_t kMaxWriters = 256;      // of a topic
constexpr std::size_t kMaxRemembered = 4096;  // writers, with those that have ended

using Name = std::unique_ptr<X509_NAME, decltype([](X509_NAME* name) { X509_NAME_free(name); })>;
using Endpoint =
    std::unique_ptr<dds_builtintopic_endpoint_t,
                    decltype([](dds_builtintopic_endpoint_t* endpoint) { dds_builtintopic_free_endpoint(endpoint); })>;

std::string name_of(const dds_builtintopic_endpoint_t& endpoint) {
  void* value = nullptr;
  std::size_t size = 0;
  if (endpoint.qos == nullptr || !dds_qget_groupdata(endpoint.qos, &value, &size) || value == nullptr) return "";
  std::string name(static_cast<const char*>(value), size);
  dds_free(value);
  return name;
}

// 0: the name is not that of the certificate; nullopt: DDS does not know the writer, which may have ended.
std::optional<std::uint64_t> read_host(dds_entity_t reader, dds_instance_handle_t writer) {
  const Endpoint endpoint(dds_get_matched_publication_data(reader, writer));
  if (!endpoint) return std::nullopt;
  const std::string name = name_of(*endpoint);
  for (const NameEncoding encoding : {NameEncoding::utf8, NameEncoding::printable})
    if (std::ranges::equal(guid_prefix_of(name, encoding), std::span(endpoint->participant_key.v).first<6>()))
      return host_id(name);
  return 0;
}

}  // namespace

GuidPrefix guid_prefix_of(std::string_view name, NameEncoding encoding) {
  const Name subject(X509_NAME_new());
  X509_NAME_add_entry_by_txt(subject.get(), "CN",
                             encoding == NameEncoding::utf8 ? V_ASN1_UTF8STRING : V_ASN1_PRINTABLESTRING,
                             reinterpret_cast<const unsigned char*>(name.data()), static_cast<int>(name.size()), -1, 0);
  unsigned char* encoded = nullptr;
  const int length = i2d_X509_NAME(subject.get(), &encoded);
  std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
  if (length > 0) SHA256(encoded, static_cast<std::size_t>(length), hash.data());
  OPENSSL_free(encoded);
  // The hash moved by one bit, after a first bit that is set.
  GuidPrefix prefix{};
  unsigned carried = 1;
  for (std::size_t i = 0; i < prefix.size(); ++i) {
    prefix[i] = static_cast<std::uint8_t>(carried << 7 | hash[i] >> 1);
    carried = hash[i] & 1U;
  }
  return prefix;
}

std::uint64_t Senders::host_of(dds_entity_t reader, dds_instance_handle_t writer) {
  if (const auto found = hosts_.find(writer); found != hosts_.end()) return found->second;
  const auto host = read_host(reader, writer);
  if (!host) return 0;
  if (hosts_.size() >= kMaxRemembered) hosts_.clear();
  return hosts_[writer] = *host;
}

void Senders::update(dds_entity_t reader, Topic topic) {
  dds_subscription_matched_status_t status{};
  if (reader <= 0 || dds_get_subscription_matched_status(reader, &status) != DDS_RETCODE_OK) return;
  if (status.total_count_change == 0 && status.current_count_change == 0) return;
  std::array<dds_instance_handle_t, kMaxWriters> matched{};
  const auto count = static_cast<std::size_t>(
      std::max<dds_return_t>(dds_get_matched_publications(reader, matched.data(), matched.size()), 0));
  auto& hosts = writers_[index_of(topic)];
  hosts.clear();
  for (const dds_instance_handle_t writer : std::span(matched).first(std::min(count, kMaxWriters)))
    if (const std::uint64_t host = host_of(reader, writer); host != 0) hosts.push_back(host);
}

bool Senders::writes(std::uint64_t host, Topic topic) const {
  return std::ranges::find(writers_[index_of(topic)], host) != writers_[index_of(topic)].end();
}

}  // namespace yars::gateway::dds
