// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calibration/web/web_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <sstream>
#include <stdexcept>

namespace insitu {

WebClient::WebClient(int port, int receive_buffer)
    : port_(port), socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  if (receive_buffer > 0) {
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  }
  const timeval patience = {5, 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("no connection");
  }
}

WebClient::~WebClient() { close(socket_); }

void WebClient::Write(const std::string& bytes) {
  for (size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;  // what it answered may still be read
    sent += static_cast<size_t>(count);
  }
}

bool WebClient::Receive() {
  std::array<char, 65536> bytes;
  const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
  if (count <= 0) return false;
  received_.append(bytes.data(), static_cast<size_t>(count));
  return true;
}

std::optional<std::string> WebClient::ReadBytes(size_t count) {
  while (received_.size() < count) {
    if (!Receive()) return std::nullopt;
  }
  std::string bytes = received_.substr(0, count);
  received_.erase(0, count);
  return bytes;
}

std::optional<WebReply> WebClient::ReadReply() {
  size_t end = 0;
  while ((end = received_.find("\r\n\r\n")) == std::string::npos) {
    if (!Receive()) return std::nullopt;
  }
  std::istringstream head(*ReadBytes(end + 4));
  WebReply reply;
  std::string line, version;
  head >> version >> reply.status;
  std::getline(head, line);
  while (std::getline(head, line) && line != "\r") {
    const size_t colon = line.find(": ");
    for (size_t i = 0; i < colon; ++i) line[i] = static_cast<char>(std::tolower(line[i]));
    reply.fields[line.substr(0, colon)] = line.substr(colon + 2, line.size() - colon - 3);
  }
  if (!reply.fields.contains("content-length")) return reply;
  const auto body = ReadBytes(std::stoul(reply.fields["content-length"]));
  if (!body) return std::nullopt;
  reply.body = *body;
  return reply;
}

std::optional<WebReply> WebClient::Ask(const std::string& method, const std::string& target,
                                       const std::string& token, const std::string& fields,
                                       const std::string& body) {
  Write(method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) + "\r\n" +
        (token.empty() ? "" : "Authorization: Bearer " + token + "\r\n") + fields +
        (body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") + "\r\n" +
        body);
  return ReadReply();
}

int WebClient::Upgrade(const std::string& target, const std::string& fields) {
  const std::string own = "127.0.0.1:" + std::to_string(port_);
  Write("GET " + target + " HTTP/1.1\r\n" +
        (fields.empty() ? "Host: " + own + "\r\nOrigin: http://" + own + "\r\n" : fields) +
        "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  const auto reply = ReadReply();
  return reply ? reply->status : 0;
}

// RFC 6455, 5.2, with a mask of zeros.
void WebClient::WriteFrame(int opcode, const std::string& payload) {
  std::string frame(1, static_cast<char>(0x80 | opcode));
  const int bytes = payload.size() < 126 ? 0 : payload.size() < 65536 ? 2 : 8;
  frame += static_cast<char>(0x80 | (bytes == 0 ? payload.size() : bytes == 2 ? 126 : 127));
  for (int i = bytes - 1; i >= 0; --i) frame += static_cast<char>(payload.size() >> (8 * i));
  Write(frame + std::string(4, '\0') + payload);
}

void WebClient::WriteMessage(const std::string& text) { WriteFrame(1, text); }

std::optional<std::string> WebClient::ReadMessage() {
  while (true) {
    const auto head = ReadBytes(2);
    if (!head) return std::nullopt;
    size_t size = (*head)[1] & 0x7f;
    if (size > 125) {
      const auto bytes = ReadBytes(size == 126 ? 2 : 8);
      if (!bytes) return std::nullopt;
      size = 0;
      for (const char byte : *bytes) size = size << 8 | static_cast<unsigned char>(byte);
    }
    const auto payload = ReadBytes(size);
    if (!payload) return std::nullopt;
    const int opcode = (*head)[0] & 0x0f;
    if (opcode == 1) return payload;
    if (opcode == 9) WriteFrame(10, *payload);
    if (opcode != 8) continue;
    if (size >= 2) {
      close_code_ = static_cast<unsigned char>((*payload)[0]) << 8 |
                    static_cast<unsigned char>((*payload)[1]);
    }
    WriteFrame(8, *payload);
    shutdown(socket_, SHUT_WR);
    return std::nullopt;
  }
}

}  // namespace insitu
