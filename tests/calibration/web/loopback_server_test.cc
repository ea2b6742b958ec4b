// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/web/loopback_server.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include "calibration/web/request_guard.h"
#include "tests/calibration/files/scratch_folder.h"
#include "tests/calibration/web/web_client.h"

namespace insitu {
namespace {

using std::chrono::seconds;

// What callbacks said, one after the other.
class Journal {
 public:
  void Add(const std::string& text) {
    const std::lock_guard lock(mutex_);
    lines_.push_back(text);
    changed_.notify_all();
  }
  // Whether so many come within five seconds.
  bool Waits(size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, seconds(5), [&] { return lines_.size() >= count; });
  }
  std::vector<std::string> lines() {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> lines_;
};

class LoopbackServerTest : public testing::Test {
 protected:
  LoopbackServerTest() {
    options_.token = NewToken();
    options_.public_resources = {{"/", {"text/html; charset=utf-8", "<!DOCTYPE html>"}}};
    options_.slow_paths = {"/api/slow"};
    options_.most_queued_bytes = 4 << 20;
    callbacks_.on_request = [this](const WebRequest& request) { return Answer(request); };
    callbacks_.on_opened = [this](int window) { journal_.Add("+" + std::to_string(window)); };
    callbacks_.on_closed = [this](int window) { journal_.Add("-" + std::to_string(window)); };
    callbacks_.on_message = [this](int window, const std::string& text) {
      journal_.Add(std::to_string(window) + ":" + text);
      if (text == "fail") throw std::runtime_error("no such message");
    };
  }

  ~LoopbackServerTest() override {
    release_.set_value();
    if (server_) server_->Stop();
    if (runner_.joinable()) runner_.join();
  }

  WebResponse Answer(const WebRequest& request) {
    if (request.path == "/api/bad") throw InputError("survey.csv", 7, "no number");
    if (request.path == "/api/broken") throw std::runtime_error("out of order");
    if (request.path == "/api/slow") released_.wait();
    if (request.path == "/api/tile") return {200, "image/jpeg", "tile", 60};
    std::string text = request.method + " " + request.path;
    for (const auto& [name, value] : request.query)
      text.append(" ").append(name).append("=").append(value);
    return {200, "text/plain", text + " " + request.body};
  }

  int Start() {
    server_ = std::make_unique<LoopbackServer>(options_, callbacks_);
    runner_ = std::thread([this] { server_->Run(); });
    return server_->port();
  }

  std::string TokenMessage() const { return "{\"token\": \"" + options_.token + "\"}"; }

  std::unique_ptr<WebClient> OpenWindow(int port, int receive_buffer = 0) {
    auto client = std::make_unique<WebClient>(port, receive_buffer);
    const size_t before = journal_.lines().size();
    EXPECT_EQ(client->Upgrade("/api/live"), 101);
    client->WriteMessage(TokenMessage());
    EXPECT_TRUE(journal_.Waits(before + 1));
    return client;
  }

  LoopbackServerOptions options_;
  LoopbackServerCallbacks callbacks_;
  Journal journal_;
  std::promise<void> release_;
  std::shared_future<void> released_ = release_.get_future().share();
  std::unique_ptr<LoopbackServer> server_;
  std::thread runner_;
};

TEST_F(LoopbackServerTest, ServesThePageWithoutAToken) {
  WebClient client(Start());
  const auto reply = client.Ask("GET", "/");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->status, 200);
  EXPECT_EQ(reply->body, "<!DOCTYPE html>");
  EXPECT_EQ(reply->fields.at("content-type"), "text/html; charset=utf-8");
  EXPECT_EQ(reply->fields.at("content-security-policy"),
            "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' ws://127.0.0.1:" +
                std::to_string(server_->port()) +
                "; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
  EXPECT_EQ(reply->fields.at("x-content-type-options"), "nosniff");
  EXPECT_EQ(reply->fields.at("cache-control"), "no-store");
  EXPECT_FALSE(reply->fields.contains("access-control-allow-origin"));
  EXPECT_EQ(server_->address(), "http://127.0.0.1:" + std::to_string(server_->port()) + "/");
}

TEST_F(LoopbackServerTest, AnswersRequestAfterRequestOnOneConnection) {
  WebClient client(Start());
  const std::string& token = options_.token;
  EXPECT_EQ(client.Ask("GET", "/api/site?a=1&b=x%20y", token)->body, "GET /api/site a=1 b=x y ");
  EXPECT_EQ(client.Ask("POST", "/api/op", token, "", "{\"id\": 1}")->body,
            "POST /api/op {\"id\": 1}");
  EXPECT_EQ(client.Ask("GET", "/api/tile", token)->fields.at("cache-control"),
            "private, max-age=60");
  const auto bad = client.Ask("GET", "/api/bad", token);
  EXPECT_EQ(bad->status, 400);
  EXPECT_EQ(bad->body, "{\"error\":\"survey.csv:7: no number\"}");
  const auto broken = client.Ask("GET", "/api/broken", token);
  EXPECT_EQ(broken->status, 500);
  EXPECT_EQ(broken->body, "{\"error\":\"out of order\"}");
  EXPECT_EQ(client.Ask("GET", "/")->status, 200);
  const auto last = client.Ask("GET", "/api/site", token, "Connection: close\r\n");
  EXPECT_EQ(last->status, 200);
  EXPECT_FALSE(client.ReadReply());
}

TEST_F(LoopbackServerTest, RefusesAttacks) {
  const int port = Start();
  const std::string own = "Host: 127.0.0.1:" + std::to_string(port) + "\r\n";
  const std::string bearer = "Authorization: Bearer " + options_.token + "\r\n";
  struct Attack {
    std::string line, fields;
    int status;
  };
  const std::string foreign = "Host: evil.example\r\n";
  for (const Attack& attack : std::vector<Attack>{
           {"GET /api/site", own, 401},
           {"GET /api/site?token=" + options_.token, own, 401},
           {"POST /", own, 401},
           {"GET /api/site", "Host: evil.example\r\n" + bearer, 403},
           {"GET /", "Host: evil.example\r\n", 403},
           {"GET /", "", 403},
           {"GET /api/site", std::string(own).append(foreign).append(bearer), 400},
           {"GET /api/site", own + bearer + "Origin: null\r\n", 403},
           {"POST /api/op", own + bearer + "Origin: http://evil.example\r\n", 403},
           {"GET /api/site", own + bearer + "Sec-Fetch-Site: cross-site\r\n", 403},
           {"GET /../../etc/passwd", own + bearer, 400},
           {"GET /%2e%2e/etc/passwd", own + bearer, 400},
           {"GET http://evil.example/", own + bearer, 400},
           {"OPTIONS /api/op", own + bearer + "Origin: http://evil.example\r\n", 405},
           {"DELETE /api/site", own + bearer, 405},
           {"nonsense", own, 400},
           {"GET /" + std::string(20000, 'a'), own + bearer, 431},
       }) {
    WebClient client(port);
    client.Write(attack.line + " HTTP/1.1\r\n" + attack.fields + "\r\n");
    const auto reply = client.ReadReply();
    ASSERT_TRUE(reply) << attack.line;
    EXPECT_EQ(reply->status, attack.status) << attack.line << "\n" << attack.fields;
    EXPECT_TRUE(reply->body.starts_with("{\"error\":")) << reply->body;
    EXPECT_FALSE(reply->fields.contains("access-control-allow-origin"));
  }
}

TEST_F(LoopbackServerTest, RefusesBodiesThatAreTooLarge) {
  const int port = Start();
  const std::string body((1 << 20) + 1, 'x');
  EXPECT_EQ(WebClient(port).Ask("POST", "/api/op", options_.token, "", body)->status, 413);
  EXPECT_EQ(WebClient(port).Ask("POST", "/api/op", "", "", "{}")->status, 401);
  const std::string most = body.substr(1);
  EXPECT_EQ(WebClient(port).Ask("POST", "/api/op", options_.token, "", most)->status, 200);
}

TEST_F(LoopbackServerTest, TellsConnectionsBeyondTheMostThatTheyAre) {
  options_.most_connections = 3;
  const int port = Start();
  std::vector<std::unique_ptr<WebClient>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(std::make_unique<WebClient>(port));
    EXPECT_EQ(clients.back()->Ask("GET", "/")->status, 200);
  }
  WebClient beyond(port);
  EXPECT_EQ(beyond.Ask("GET", "/")->status, 503);
  EXPECT_FALSE(beyond.ReadReply());
  EXPECT_EQ(clients[0]->Ask("GET", "/")->status, 200);
  clients.pop_back();
  int status = 503;
  for (int i = 0; i < 200 && status == 503; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    status = WebClient(port).Ask("GET", "/")->status;
  }
  EXPECT_EQ(status, 200);
}

// Else a run of a stage would hold the port and the connections after its server has ended.
TEST_F(LoopbackServerTest, GivesNothingToChildren) {
  const auto window = OpenWindow(Start());
  int sockets = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int descriptor = std::stoi(entry.path().filename());
    struct stat status = {};
    if (descriptor <= STDERR_FILENO || fstat(descriptor, &status) != 0) continue;
    if (!S_ISSOCK(status.st_mode)) continue;
    ++sockets;
    EXPECT_TRUE(fcntl(descriptor, F_GETFD) & FD_CLOEXEC) << descriptor;
  }
  EXPECT_EQ(sockets, 3);  // the port, the window's two ends
}

TEST_F(LoopbackServerTest, AnswersWhileSlowRequestsRun) {
  const int port = Start();
  std::vector<std::unique_ptr<WebClient>> slow;
  for (int i = 0; i < 6; ++i) {
    slow.push_back(std::make_unique<WebClient>(port));
    slow.back()->Write("GET /api/slow HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " +
                       options_.token + "\r\n\r\n");
  }
  EXPECT_EQ(WebClient(port).Ask("GET", "/api/site", options_.token)->status, 200);
  EXPECT_EQ(WebClient(port).Ask("GET", "/")->status, 200);
}

TEST_F(LoopbackServerTest, SendsToAllWindowsInOrder) {
  const int port = Start();
  const auto first = OpenWindow(port), second = OpenWindow(port);
  std::vector<std::thread> senders;
  for (int sender = 0; sender < 4; ++sender) {
    senders.emplace_back([this, sender] {
      for (int i = 0; i < 200; ++i) server_->Send(std::to_string(1000 * sender + i));
    });
  }
  for (std::thread& sender : senders) sender.join();
  std::map<int, int> last;
  for (int i = 0; i < 800; ++i) {
    const auto text = first->ReadMessage();
    ASSERT_TRUE(text);
    ASSERT_EQ(text, second->ReadMessage());
    const int number = std::stoi(*text);
    EXPECT_EQ(number % 1000, last[number / 1000]++);
  }
  server_->SendTo(2, "for the second");
  server_->Send("for both");
  EXPECT_EQ(first->ReadMessage(), "for both");
  EXPECT_EQ(second->ReadMessage(), "for the second");
}

TEST_F(LoopbackServerTest, TellsWhatWindowsDoInOrder) {
  const int port = Start();
  {
    const auto window = OpenWindow(port);
    for (int i = 0; i < 20; ++i) window->WriteMessage(std::to_string(i));
    EXPECT_TRUE(journal_.Waits(21));
  }
  ASSERT_TRUE(journal_.Waits(22));
  const std::vector<std::string> lines = journal_.lines();
  EXPECT_EQ(lines.front(), "+1");
  for (int i = 0; i < 20; ++i) EXPECT_EQ(lines[i + 1], "1:" + std::to_string(i));
  EXPECT_EQ(lines.back(), "-1");
  server_->SendTo(1, "to nobody");
}

TEST_F(LoopbackServerTest, ClosesAWindowWhoseMessageFails) {
  const int port = Start();
  const auto window = OpenWindow(port);
  window->WriteMessage("fail");
  EXPECT_FALSE(window->ReadMessage());
  EXPECT_EQ(window->close_code(), 1008);
  ASSERT_TRUE(journal_.Waits(3));
  EXPECT_EQ(journal_.lines().back(), "-1");
}

TEST_F(LoopbackServerTest, RefusesWindowsOfOthers) {
  const int port = Start();
  const std::string own = "127.0.0.1:" + std::to_string(port);
  EXPECT_EQ(WebClient(port).Upgrade("/api/live", "Host: " + own + "\r\n"), 403);
  EXPECT_EQ(
      WebClient(port).Upgrade("/api/live", "Host: " + own + "\r\nOrigin: http://evil.example\r\n"),
      403);
  EXPECT_EQ(
      WebClient(port).Upgrade("/api/live", "Host: evil.example\r\nOrigin: http://evil.example\r\n"),
      403);
  EXPECT_EQ(WebClient(port).Upgrade("/api/other"), 401);
  for (const std::string message : {"{\"token\": \"0123456789abcdef0123456789abcdef\"}",
                                    "{\"token\": null}", "{}", "[1]", "x", "{\"focus\": 1}"}) {
    WebClient client(port);
    ASSERT_EQ(client.Upgrade("/api/live"), 101);
    server_->Send("a secret");
    client.WriteMessage(message);
    EXPECT_FALSE(client.ReadMessage()) << message;
    EXPECT_EQ(client.close_code(), 1008);
  }
  WebClient client(port);
  ASSERT_EQ(client.Upgrade("/api/live"), 101);
  client.WriteMessage(std::string(100000, '['));
  EXPECT_FALSE(client.ReadMessage());
  EXPECT_TRUE(journal_.lines().empty());
}

TEST_F(LoopbackServerTest, RefusesMessagesThatAreTooLarge) {
  const int port = Start();
  const auto window = OpenWindow(port);
  window->WriteMessage(std::string(1 << 20, 'x'));
  ASSERT_TRUE(journal_.Waits(2));
  window->WriteMessage(std::string((1 << 20) + 1, 'x'));
  EXPECT_FALSE(window->ReadMessage());
  EXPECT_EQ(window->close_code(), 1009);
}

TEST_F(LoopbackServerTest, DoesNotWaitForAWindowThatDoesNotRead) {
  const int port = Start();
  const auto asleep = OpenWindow(port, 4096), awake = OpenWindow(port);
  const std::string text(100000, 'x');
  for (int i = 0; i < 200; ++i) {
    server_->Send(text);
    ASSERT_TRUE(awake->ReadMessage() == text) << i;
  }
  ASSERT_TRUE(journal_.Waits(3));
  EXPECT_EQ(journal_.lines().back(), "-1");
  EXPECT_EQ(WebClient(port).Ask("GET", "/")->status, 200);
}

TEST_F(LoopbackServerTest, StopsFromACallback) {
  callbacks_.on_request = [this](const WebRequest&) {
    server_->Stop();
    return WebResponse();
  };
  WebClient client(Start());
  client.Write("GET /api/quit HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " +
               options_.token + "\r\n\r\n");
  runner_.join();
  server_.reset();
  EXPECT_FALSE(client.ReadReply());
}

TEST_F(LoopbackServerTest, StopsWithWindowsOpen) {
  const int port = Start();
  const auto window = OpenWindow(port);
  for (int i = 0; i < 100; ++i) server_->Send(std::string(100000, 'x'));
  server_->Stop();
  runner_.join();
  server_.reset();
  while (window->ReadMessage()) {
  }
  EXPECT_THROW(WebClient{port}, std::runtime_error);
}

// [s] until the other side closes.
template <typename Read>
double UntilClosed(Read read) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_FALSE(read());
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// A WebClient itself gives up after five seconds.
constexpr double kClosedByServer = 4;

TEST_F(LoopbackServerTest, ClosesConnectionsThatFallSilent) {
  using std::chrono::milliseconds;
  options_.times = {.idle = milliseconds(500), .body = milliseconds(100)};
  const int port = Start();
  WebClient silent(port), halfway(port), bodiless(port);
  EXPECT_EQ(silent.Ask("GET", "/")->status, 200);
  halfway.Write("GET / HTTP/1.1\r\nHost: 127");
  const double after_answer = UntilClosed([&] { return silent.ReadReply(); });
  EXPECT_GT(after_answer, 0.4);
  EXPECT_LT(after_answer, kClosedByServer);
  EXPECT_LT(UntilClosed([&] { return halfway.ReadReply(); }), kClosedByServer);
  bodiless.Write("POST /api/op HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                 "\r\nAuthorization: Bearer " + options_.token + "\r\nContent-Length: 9\r\n\r\n{");
  EXPECT_LT(UntilClosed([&] { return bodiless.ReadReply(); }), kClosedByServer);
}

TEST_F(LoopbackServerTest, ClosesWindowsThatFallSilentAndKeepsThoseThatAnswerPings) {
  using std::chrono::milliseconds;
  options_.times.token = options_.times.window = milliseconds(600);
  const int port = Start();
  WebClient without_token(port);
  EXPECT_EQ(without_token.Upgrade("/api/live"), 101);
  EXPECT_LT(UntilClosed([&] { return without_token.ReadMessage(); }), kClosedByServer);
  const auto silent = OpenWindow(port), answering = OpenWindow(port);
  std::thread reader([&] { EXPECT_EQ(answering->ReadMessage(), "still here"); });
  ASSERT_TRUE(journal_.Waits(3));
  EXPECT_EQ(journal_.lines().back(), "-1");
  server_->Send("still here");
  reader.join();
}

TEST_F(LoopbackServerTest, NamesThePortThatIsTaken) {
  options_.port = Start();
  EXPECT_EQ(InputErrorOf([&] {
              LoopbackServer(options_, callbacks_);
            }).find("port " + std::to_string(options_.port) + ": cannot be served on"),
            0u);
  options_.port = 70000;
  EXPECT_EQ(InputErrorOf([&] { options_.Check(); }), "port 70000: expected 0 to 65535");
  options_.port = 0;
  options_.token = "short";
  EXPECT_THROW(options_.Check(), CheckError);
}

}  // namespace
}  // namespace insitu
