// Requests of browsers: hosts, origins and paths that are answered.
#include "station/access.hpp"

#include <gtest/gtest.h>

namespace yars::station {
namespace {

AccessRules local() {
  AccessRules rules;
  rules.port = 8096;
  return rules;
}

AccessRules open_to_all() {
  AccessRules rules = local();
  rules.names = {"radar.example"};
  rules.viewer_token = "0123456789abcdef";
  rules.instructor_token = "fedcba9876543210";
  return rules;
}

Origins direct(std::string_view host, const AccessRules& rules) {
  return origins_of(host, "10.0.0.9", {}, rules);
}

// With any port: tunnels and containers map ports.
TEST(Access, OnlyNamesThatLeadToThisComputerAreHosts) {
  for (const char* host : {"127.0.0.1:8096", "localhost:8096", "[::1]:8096", "127.0.0.1", "localhost:9000",
                           "10.0.0.1:8096", "127.0.0.2:80", "[fe80::1]"})
    EXPECT_TRUE(is_allowed_host(host, local())) << host;
  for (const char* host : {"", ":8096", "127.0.0.1:809600", "localhost:", "localhost:x", "localhost.evil.example:8096",
                           "evil.example:8096", "10.0.0.1.evil.example:8096", "[evil]:80", "[]", "radar.example:8096"})
    EXPECT_FALSE(is_allowed_host(host, local())) << host;
  for (const char* host : {"radar.example", "radar.example:8096", "localhost"})
    EXPECT_TRUE(is_allowed_host(host, open_to_all())) << host;
  EXPECT_TRUE(is_allowed_host(direct("Radar.Example:443", open_to_all()).host, open_to_all()));
}

TEST(Access, OnlyPagesOfThisServerAreOrigins) {
  const Origins plain = direct("localhost:8096", local());
  for (const char* origin : {"http://localhost:8096", "https://localhost:8096", "http://LOCALHOST:8096"})
    EXPECT_TRUE(is_own_origin(origin, plain)) << origin;
  for (const char* origin :
       {"", "null", "http://localhost:80", "http://evil.example", "file://", "http://localhost:8096.evil"})
    EXPECT_FALSE(is_own_origin(origin, plain)) << origin;
  AccessRules safe = local();
  safe.tls = true;
  EXPECT_TRUE(is_own_origin("https://localhost:8096", direct("localhost:8096", safe)));
  EXPECT_FALSE(is_own_origin("http://localhost:8096", direct("localhost:8096", safe)));
}

TEST(Access, HeadersOfAProxyAreBelievedWhereThereIsOne) {
  const Forwarded forwarded{"evil.example, Radar.example", "http, https", "1.2.3.4, 10.0.0.7"};
  const Origins alone = origins_of("127.0.0.1:8096", "10.0.0.9", forwarded, local());
  EXPECT_EQ(alone.host, "127.0.0.1:8096");
  EXPECT_FALSE(alone.https);
  EXPECT_EQ(alone.visitor, "10.0.0.9");
  AccessRules rules = open_to_all();
  rules.behind_proxy = true;
  const Origins behind = origins_of("127.0.0.1:8096", "127.0.0.1", forwarded, rules);
  EXPECT_EQ(behind.host, "radar.example");
  EXPECT_TRUE(behind.https);
  EXPECT_EQ(behind.visitor, "10.0.0.7") << "what the visitor itself has sent comes before";
  EXPECT_TRUE(is_own_origin("https://radar.example", behind));
  EXPECT_FALSE(is_own_origin("http://radar.example", behind));
  EXPECT_NE(cookie_of_token(rules.viewer_token, behind, rules).find("; Secure"), std::string::npos);
  EXPECT_EQ(origins_of("Radar.example", "127.0.0.1", {}, rules).host, "radar.example");
}

TEST(Access, NamesOfHosts) {
  for (const char* name : {"radar.example", "a", "my-host", "10.0.0.1"}) EXPECT_TRUE(is_host_name(name)) << name;
  for (const char* name : {"", "-a", ".a", "a..b", "a b", "a:80", "*", "a/b", "ä"})
    EXPECT_FALSE(is_host_name(name)) << name;
  EXPECT_FALSE(is_host_name(std::string(254, 'a')));
}

TEST(Access, WithoutTokensEveryPageIsAnInstructors) {
  EXPECT_EQ(right_of_cookies("", local()), Right::instructor);
  EXPECT_EQ(right_of_token("", local()), Right::instructor);
}

TEST(Access, TokensGiveRights) {
  const AccessRules rules = open_to_all();
  EXPECT_EQ(right_of_token(rules.viewer_token, rules), Right::viewer);
  EXPECT_EQ(right_of_token(rules.instructor_token, rules), Right::instructor);
  for (const char* token : {"", "0", "0123456789abcdef0", "0123456789abcdeF"})
    EXPECT_EQ(right_of_token(token, rules), Right::none) << token;
}

TEST(Access, CookiesCarryTheTokenOfThisPort) {
  const AccessRules rules = open_to_all();
  const std::string cookie = cookie_of_token(rules.viewer_token, direct("localhost:8096", rules), rules);
  EXPECT_NE(cookie.find("HttpOnly"), std::string::npos);
  EXPECT_NE(cookie.find("SameSite=Lax"), std::string::npos) << "with Strict a link in a web mail ends with 401";
  const std::string pair = cookie.substr(0, cookie.find(';'));
  EXPECT_EQ(right_of_cookies(pair, rules), Right::viewer);
  EXPECT_EQ(right_of_cookies("a=b; " + pair + "; c=d", rules), Right::viewer);
  for (const char* beside : {"yars_station_8096_instructor=wrong", "yars_station_8096_instructor", "yars_station_8096"})
    EXPECT_EQ(right_of_cookies(std::string(beside) + "; " + pair, rules), Right::viewer) << beside;
  AccessRules other = rules;
  other.port = 8097;
  EXPECT_EQ(right_of_cookies(pair, other), Right::none);
  for (const char* cookies : {"", ";", "yars_station_8096_viewer=", "yars_station_8096_viewer", "x", "; ;=;"})
    EXPECT_EQ(right_of_cookies(cookies, rules), Right::none) << cookies;
}

TEST(Access, ACookieOfViewersReplacesNoneOfAnInstructor) {
  const AccessRules rules = open_to_all();
  const auto pair_of = [&](const std::string& token) {
    const std::string cookie = cookie_of_token(token, direct("localhost:8096", rules), rules);
    return cookie.substr(0, cookie.find(';'));
  };
  const std::string viewer = pair_of(rules.viewer_token), instructor = pair_of(rules.instructor_token);
  EXPECT_NE(viewer.substr(0, viewer.find('=')), instructor.substr(0, instructor.find('=')));
  EXPECT_EQ(right_of_cookies(instructor, rules), Right::instructor);
  EXPECT_EQ(right_of_cookies(instructor + "; " + viewer, rules), Right::instructor);
  EXPECT_EQ(right_of_cookies(viewer + "; " + instructor, rules), Right::instructor);
}

TEST(Access, ParametersAreWordsOfTheQuery) {
  EXPECT_EQ(parameter_of("/socket?page=instructor&session=a-b_1", "session"), "a-b_1");
  EXPECT_EQ(parameter_of("/socket?page=instructor&session=a-b_1", "page"), "instructor");
  for (const char* path :
       {"/socket", "/socket?", "/socket?session=", "/socket?session=../x", "/socket?xsession=a", "/session=a"})
    EXPECT_EQ(parameter_of(path, "session"), std::nullopt) << path;
}

TEST(Access, PathsNameFilesOfOneFolder) {
  EXPECT_EQ(file_of_path("/"), "display.html");
  EXPECT_EQ(file_of_path("/?x=1"), "display.html");
  EXPECT_EQ(file_of_path("/display.js?v=2"), "display.js");
  for (const char* path : {"", "display.js", "/..", "/../passwd", "/a/b", "/.hidden", "/%2e%2e", "http://x/", "*"})
    EXPECT_EQ(file_of_path(path), "") << path;
}

TEST(Access, TheContentPolicyAllowsTheServerAlone) {
  const std::string policy = content_policy(direct("127.0.0.1:8096", local()));
  EXPECT_NE(policy.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  EXPECT_NE(policy.find("ws://127.0.0.1:8096"), std::string::npos);
}

}  // namespace
}  // namespace yars::station
