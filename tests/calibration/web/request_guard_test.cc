// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/request_guard.h"

#include <gtest/gtest.h>

namespace insitu {
namespace {

using Kind = RequestHead::Kind;

constexpr char kToken[] = "0123456789abcdef0123456789abcdef";
const HeaderField kHost = {"host", "127.0.0.1:8080"};
const HeaderField kOrigin = {"origin", "http://127.0.0.1:8080"};
const HeaderField kBearer = {"authorization", std::string("Bearer ") + kToken};

struct Case {
  const char* what;
  Kind kind;
  std::vector<HeaderField> fields;
  int status;  // 0: admitted
};

void PrintTo(const Case& c, std::ostream* stream) { *stream << c.what; }

class RequestGuard : public testing::TestWithParam<Case> {};

TEST_P(RequestGuard, AdmitsOrRefuses) {
  const auto refusal = RefusalOf({GetParam().kind, GetParam().fields}, kToken);
  EXPECT_EQ(refusal ? refusal->status : 0, GetParam().status) << (refusal ? refusal->reason : "");
}

const Case kCases[] = {
    {"the page by its address", Kind::kPublic, {kHost, {"sec-fetch-site", "none"}}, 0},
    {"the page by a program without such fields", Kind::kPublic, {kHost}, 0},
    {"a resource of the page", Kind::kPublic, {kHost, {"sec-fetch-site", "same-origin"}}, 0},
    {"the page from the file that leads to it",
     Kind::kPublic,
     {kHost,
      {"sec-fetch-site", "cross-site"},
      {"sec-fetch-mode", "navigate"},
      {"sec-fetch-dest", "document"}},
     0},
    {"the page in a foreign frame",
     Kind::kPublic,
     {kHost,
      {"sec-fetch-site", "cross-site"},
      {"sec-fetch-mode", "navigate"},
      {"sec-fetch-dest", "iframe"}},
     403},
    {"a script of the page in a foreign one",
     Kind::kPublic,
     {kHost,
      {"sec-fetch-site", "cross-site"},
      {"sec-fetch-mode", "no-cors"},
      {"sec-fetch-dest", "script"}},
     403},
    {"data", Kind::kToken, {kHost, kBearer}, 0},
    {"data for the page", Kind::kToken, {kHost, kOrigin, kBearer}, 0},
    {"data through ssh -L",
     Kind::kToken,
     {{"host", "localhost:9000"}, {"origin", "http://localhost:9000"}, kBearer},
     0},
    {"data by IPv6's name", Kind::kToken, {{"host", "[::1]:80"}, kBearer}, 0},
    {"data without a port", Kind::kToken, {{"host", "localhost"}, kBearer}, 0},
    {"no token", Kind::kToken, {kHost}, 401},
    {"an empty token", Kind::kToken, {kHost, {"authorization", "Bearer "}}, 401},
    {"half the token", Kind::kToken, {kHost, {"authorization", "Bearer 0123456789abcdef"}}, 401},
    {"the token and more", Kind::kToken, {kHost, {"authorization", kBearer.value + "0"}}, 401},
    {"another token",
     Kind::kToken,
     {kHost, {"authorization", "Bearer 0123456789abcdef0123456789abcdee"}},
     401},
    {"the token without its scheme", Kind::kToken, {kHost, {"authorization", kToken}}, 401},
    {"the token as a cookie",
     Kind::kToken,
     {kHost, {"cookie", std::string("token=") + kToken}},
     401},
    {"no host", Kind::kToken, {kBearer}, 403},
    {"DNS rebinding", Kind::kToken, {{"host", "evil.example:8080"}, kBearer}, 403},
    {"DNS rebinding of the page", Kind::kPublic, {{"host", "evil.example"}}, 403},
    {"a host that begins like ours", Kind::kPublic, {{"host", "localhost.evil.example"}}, 403},
    {"an address that begins like ours", Kind::kPublic, {{"host", "127.0.0.1.nip.io:80"}}, 403},
    {"a user before the host", Kind::kPublic, {{"host", "127.0.0.1:80@evil.example"}}, 403},
    {"a host with a point at its end", Kind::kPublic, {{"host", "localhost.:80"}}, 403},
    {"an empty port", Kind::kPublic, {{"host", "localhost:"}}, 403},
    {"a port in words", Kind::kPublic, {{"host", "localhost:http"}}, 403},
    {"all addresses", Kind::kPublic, {{"host", "0.0.0.0:8080"}}, 403},
    {"two hosts", Kind::kPublic, {kHost, kHost}, 400},
    {"two tokens", Kind::kToken, {kHost, kBearer, kBearer}, 400},
    {"a foreign origin", Kind::kToken, {kHost, {"origin", "http://evil.example"}, kBearer}, 403},
    {"a null origin", Kind::kToken, {kHost, {"origin", "null"}, kBearer}, 403},
    {"an empty origin", Kind::kToken, {kHost, {"origin", ""}, kBearer}, 403},
    {"another program's page here",
     Kind::kToken,
     {kHost, {"origin", "http://127.0.0.1:3000"}, kBearer},
     403},
    {"another name of this machine",
     Kind::kToken,
     {kHost, {"origin", "http://localhost:8080"}, kBearer},
     403},
    {"another scheme", Kind::kToken, {kHost, {"origin", "https://127.0.0.1:8080"}, kBearer}, 403},
    {"another site", Kind::kToken, {kHost, kBearer, {"sec-fetch-site", "cross-site"}}, 403},
    {"another port's page", Kind::kToken, {kHost, kBearer, {"sec-fetch-site", "same-site"}}, 403},
    {"data by a link elsewhere",
     Kind::kToken,
     {kHost,
      kBearer,
      {"sec-fetch-site", "cross-site"},
      {"sec-fetch-mode", "navigate"},
      {"sec-fetch-dest", "document"}},
     403},
    {"a WebSocket", Kind::kWebSocket, {kHost, kOrigin}, 0},
    {"a WebSocket without origin", Kind::kWebSocket, {kHost}, 403},
    {"a WebSocket of a foreign page",
     Kind::kWebSocket,
     {kHost, {"origin", "http://evil.example"}},
     403},
    {"a WebSocket after DNS rebinding",
     Kind::kWebSocket,
     {{"host", "evil.example"}, {"origin", "http://evil.example"}},
     403},
};

INSTANTIATE_TEST_SUITE_P(Requests, RequestGuard, testing::ValuesIn(kCases));

TEST(IsSameSecret, IsEqualityOfTexts) {
  EXPECT_TRUE(IsSameSecret("abc", "abc"));
  EXPECT_TRUE(IsSameSecret("", ""));
  for (const char* other : {"", "ab", "abcd", "abd", "bbc", "abcabc"}) {
    EXPECT_FALSE(IsSameSecret(other, "abc")) << other;
    EXPECT_FALSE(IsSameSecret("abc", other)) << other;
  }
}

TEST(NewToken, Is128BitsThatDiffer) {
  const std::string token = NewToken();
  EXPECT_EQ(token.size(), 32u);
  EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(token, NewToken());
}

}  // namespace
}  // namespace insitu
