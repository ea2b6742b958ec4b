// SPDX-License-Identifier: GPL-3.0-or-later
// What a loopback server is told: its public pages, limits, and whom it calls.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "calibration/web/web_request.h"

namespace insitu {

// Of the page itself: holds no data and needs no token.
struct PublicResource {
  std::string type;  // "text/html; charset=utf-8"
  std::string text;
};

// How long the other side may be silent before it counts as gone.
struct ServerTimes {
  using Time = std::chrono::milliseconds;
  Time idle{60000};     // a connection without a request, or within its head
  Time body{30000};     // within a body
  Time answer{120000};  // while it should read an answer
  Time token{10000};    // a window before its token
  Time window{60000};   // a window, which is pinged meanwhile
};

struct LoopbackServerOptions {
  int port = 0;                                            // 0: any that is free
  std::string token;                                       // as NewToken makes it
  std::map<std::string, PublicResource> public_resources;  // by path
  std::string live_path = "/api/live";                     // of the WebSocket
  std::set<std::string> slow_paths;                        // have threads of their own
  int threads = 4;                                         // for requests and messages,
  int slow_threads = 2;                                    // for requests of slow paths
  size_t most_bytes = size_t{1} << 20;                     // of a body or message that comes in
  size_t most_queued_bytes = size_t{32} << 20;             // that wait for a window to read them
  size_t most_connections = 32;                            // further ones are told 503
  ServerTimes times = {};
  void Check() const;  // throws InputError
};

// Called from threads of the server, several at a time; what concerns one window comes in order,
// from opened to closed. A window is a number that no other one has.
struct LoopbackServerCallbacks {
  // InputError becomes status 400, any other exception 500, with {"error": what()}.
  std::function<WebResponse(const WebRequest&)> on_request;
  // What throws of these closes the window.
  std::function<void(int window)> on_opened = {};  // its token was right: it is sent to
  std::function<void(int window, const std::string& text)> on_message = {};
  std::function<void(int window)> on_closed = {};  // not when the server stops
};

}  // namespace insitu
