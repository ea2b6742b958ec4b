// SPDX-License-Identifier: GPL-3.0-or-later
// A browser's side of a loopback server, byte by byte, so that it may also do what no browser does.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace insitu {

struct WebReply {
  int status = 0;
  std::map<std::string, std::string> fields;  // names in small letters
  std::string body;
};

// What waits over five seconds for the server counts as closed.
class WebClient {
 public:
  explicit WebClient(int port, int receive_buffer = 0);  // [bytes]; 0: the system's
  ~WebClient();
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;

  void Write(const std::string& bytes);
  std::optional<WebReply> ReadReply();  // nullopt: closed

  // With Host, Authorization if there is a token, and these fields, "Name: value\r\n" each.
  std::optional<WebReply> Ask(const std::string& method, const std::string& target,
                              const std::string& token = "", const std::string& fields = "",
                              const std::string& body = "");

  // The handshake's status; `fields` instead of Host and Origin.
  int Upgrade(const std::string& target, const std::string& fields = "");
  void WriteMessage(const std::string& text);
  std::optional<std::string> ReadMessage();  // nullopt: closed
  int close_code() const { return close_code_; }

 private:
  bool Receive();
  std::optional<std::string> ReadBytes(size_t count);
  void WriteFrame(int opcode, const std::string& payload);

  int port_, socket_;
  std::string received_;
  int close_code_ = 0;
};

}  // namespace insitu
