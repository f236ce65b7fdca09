// SPDX-License-Identifier: Apache-2.0
#include "tools/console/serve_options.h"

#include <fmt/format.h>

namespace indurop::tools {

std::vector<std::string> link_words(const deploy::LinkSettings& link) {
  std::vector<std::string> words;
  const dds::NetworkSettings& network = link.network;
  words.insert(words.end(), {"--domain", std::to_string(network.domain)});
  if (!network.interface_name.empty()) {
    words.insert(words.end(), {"--interface", network.interface_name});
  }
  if (network.one_host) {
    words.emplace_back("--one-host");
  }
  if (!link.keys.empty()) {
    words.insert(words.end(), {"--keys", link.keys.string()});
  }
  return words;
}

void declare_serve_options(base::Options& app, ServeOptions& options) {
  constexpr double kMostPort = 65535;
  constexpr double kMostClients = 1000;
  constexpr double kLeastHz = 0.1;
  app.add("--node", "NAME", options.node, "Show this node only (default: all of this host)")
      .completes(base::Completion::Node);
  app.add("--port", "PORT", options.port, "Listen on this port (default 8080; 0: any that is free)")
      .range(0, kMostPort);
  app.add("--bind", "ADDRESS", options.bind,
          "Listen on this address (default 127.0.0.1); others need --cert and --key");
  app.flag("--write", options.write, "Let clients with a token or a certificate set, force, start and stop");
  app.add("--users", "FILE", options.users, "Users, their passwords and roles: a file of indurop users")
      .completes(base::Completion::File);
  app.add("--token-file", "FILE", options.token_file,
          "Tokens, one 'NAME TOKEN [ROLE]' per line; created with one token if it does not exist")
      .completes(base::Completion::File);
  app.add("--cert", "FILE", options.cert, "Certificate for TLS (PEM)").completes(base::Completion::File);
  app.add("--key", "FILE", options.key, "Private key of --cert (PEM)").completes(base::Completion::File);
  app.add("--client-ca", "FILE", options.client_ca,
          "Authority whose certificates are accepted like a token (a plant's ca.pem)")
      .completes(base::Completion::File);
  app.add("--revoked", "FILE", options.revoked,
          "Revoked certificates of --client-ca (default: revoked.pem in its folder)")
      .completes(base::Completion::File);
  app.add("--host", "NAME", options.hosts, "Another name under which clients may call this server").one_at_a_time();
  app.add("--origin", "URL", options.origins,
          "Let pages of this origin follow variables, e.g. https://app.foxglove.dev")
      .one_at_a_time();
  app.add("--foxglove", "GLOB", options.foxglove, "Show Foxglove these variables or parts of them (default: all)")
      .one_at_a_time()
      .completes(base::Completion::Variable);
  app.add("--foxglove-hz", "RATE", options.foxglove_hz, "Messages per second and variable to Foxglove (default 50)")
      .range(kLeastHz, kMostFoxgloveHz);
  app.add("--metrics", "GLOB", options.metrics, "Include the values of these variables or parts of them in /metrics")
      .one_at_a_time()
      .completes(base::Completion::Variable);
  app.add("--call", "GLOB", options.calls,
          "Let clients with the right to write call these shared functions (default: none)")
      .one_at_a_time();
  app.add("--web", "DIR", options.web, "Folder of the page (default: the installed one)")
      .completes(base::Completion::Folder);
  app.add("--audit", "FILE", options.audit, "Write the audit log to this file (default: in the state folder)")
      .completes(base::Completion::File);
  app.add("--recordings", "DIR", options.recordings,
          "Also show the recordings in this folder, in addition to black boxes")
      .completes(base::Completion::Folder);
  app.add("--clients", "COUNT", options.clients, "Maximum number of simultaneous streams (default 64)")
      .range(1, kMostClients);
  app.add("--plc", "FILE[,FILE]...", options.plc,
          "Show this PLC program with its power flow; it must be built with --watch. Use NAME:NAMESPACE=FILE if they "
          "differ from the file's name")
      .one_at_a_time()
      .completes(base::Completion::File);
  app.flag("--plant", options.plant, "Also show the boards of the network, as their agents report them");
  deploy::add_link_options(app, options.link);
}

std::vector<std::string> words_of(const ServeOptions& options) {
  std::vector<std::string> words;
  const auto value = [&words](const char* name, const std::string& text) {
    if (!text.empty()) {
      words.insert(words.end(), {name, text});
    }
  };
  value("--node", options.node);
  value("--port", std::to_string(options.port));
  value("--bind", options.bind);
  if (options.write) {
    words.emplace_back("--write");
  }
  value("--users", options.users.string());
  value("--token-file", options.token_file.string());
  value("--cert", options.cert.string());
  value("--key", options.key.string());
  value("--client-ca", options.client_ca.string());
  value("--revoked", options.revoked.string());
  for (const std::string& host : options.hosts) {
    value("--host", host);
  }
  for (const std::string& origin : options.origins) {
    value("--origin", origin);
  }
  for (const std::string& name : options.foxglove) {
    value("--foxglove", name);
  }
  value("--foxglove-hz", fmt::format("{}", options.foxglove_hz));
  for (const std::string& name : options.metrics) {
    value("--metrics", name);
  }
  for (const std::string& name : options.calls) {
    value("--call", name);
  }
  value("--web", options.web.string());
  value("--audit", options.audit.string());
  value("--recordings", options.recordings.string());
  value("--clients", std::to_string(options.clients));
  for (const std::string& program : options.plc) {
    value("--plc", program);
  }
  if (options.plant) {
    words.emplace_back("--plant");
    const std::vector<std::string> more = link_words(options.link);
    words.insert(words.end(), more.begin(), more.end());
  }
  return words;
}

}  // namespace indurop::tools
