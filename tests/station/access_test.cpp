// Requests of browsers: hosts, origins and paths that are answered.
#include "station/access.hpp"

#include <gtest/gtest.h>

namespace yars::station {
namespace {

TEST(Access, OnlyNamesOfThisComputerAreHosts) {
  for (const char* host : {"127.0.0.1:8096", "localhost:8096", "[::1]:8096"})
    EXPECT_TRUE(is_local_host(host, 8096)) << host;
  for (const char* host :
       {"", "127.0.0.1", "127.0.0.1:80960", "localhost.evil.example:8096", "evil.example:8096", "10.0.0.1:8096"})
    EXPECT_FALSE(is_local_host(host, 8096)) << host;
}

TEST(Access, OnlyPagesOfThisServerAreOrigins) {
  EXPECT_TRUE(is_own_origin("http://localhost:8096", "localhost:8096"));
  for (const char* origin :
       {"", "null", "https://localhost:8096", "http://localhost:80", "http://evil.example", "file://"})
    EXPECT_FALSE(is_own_origin(origin, "localhost:8096")) << origin;
}

TEST(Access, PathsNameFilesOfOneFolder) {
  EXPECT_EQ(file_of_path("/"), "display.html");
  EXPECT_EQ(file_of_path("/?x=1"), "display.html");
  EXPECT_EQ(file_of_path("/display.js?v=2"), "display.js");
  for (const char* path : {"", "display.js", "/..", "/../passwd", "/a/b", "/.hidden", "/%2e%2e", "http://x/", "*"})
    EXPECT_EQ(file_of_path(path), "") << path;
}

TEST(Access, TheContentPolicyAllowsTheServerAlone) {
  const std::string policy = content_policy("127.0.0.1:8096");
  EXPECT_NE(policy.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  EXPECT_NE(policy.find("ws://127.0.0.1:8096"), std::string::npos);
}

}  // namespace
}  // namespace yars::station
