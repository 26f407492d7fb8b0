// SPDX-License-Identifier: Apache-2.0
#include "lightwell/server/server.h"

#include <zlib.h>

#include "lightwell/server/http_date.h"
#include "tests/server/running_server.h"

namespace lightwell {
namespace {

class ServerTest : public testing::Test {
 protected:
  ServerTest() {
    folder_.write("secret.glb", "outside");
    folder_.write("page/index.html", "<!doctype html>");
    folder_.write("page/core/lightwell.wasm", "wasm");
    folder_.write("page/main.js", "js");
    folder_.write("page/.hidden", "hidden");
    folder_.write("packs/room one.lw.glb", pack_);
    folder_.write("packs/notes.txt", "notes");
    std::filesystem::create_symlink(folder_.path() / "secret.glb", folder_.path() / "page/link.glb");
    options_.packs = {folder_.path() / "packs", folder_.write("single.glb", single_)};
    options_.page = folder_.path() / "page";
  }

  const std::string pack_ = pack_of(300000), single_ = pack_of(6);
  const std::string total_ = std::to_string(pack_.size());
  const std::string url_ = "/packs/room%20one.lw.glb";
  TemporaryFolder folder_;
  ServerOptions options_;
};

TEST_F(ServerTest, GivesThePageAndItsFiles) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  EXPECT_EQ(connection.get("/").body, "<!doctype html>");
  EXPECT_EQ(connection.get("/?x=1").fields["content-type"], "text/html; charset=utf-8");
  EXPECT_EQ(connection.get("/core/lightwell.wasm").fields["content-type"], "application/wasm");
  EXPECT_EQ(connection.get("/main.js").fields["content-type"], "text/javascript; charset=utf-8");
  EXPECT_EQ(connection.get("/healthz").body, "ok\n");
  EXPECT_EQ(connection.get("/absent").status, 404);
}

TEST_F(ServerTest, ListsPacks) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const RawResponse list = connection.get("/packs.json");
  EXPECT_EQ(list.fields.at("content-type"), "application/json");
  EXPECT_EQ(list.body,
            "{\"packs\":[{\"name\":\"room one.lw.glb\",\"url\":\"/packs/room%20one.lw.glb\",\"bytes\":" + total_ +
                "},"
                "{\"name\":\"single.glb\",\"url\":\"/packs/single.glb\",\"bytes\":" +
                std::to_string(single_.size()) + "}]}\n");
  folder_.write("packs/a.glb", single_);
  EXPECT_NE(connection.get("/packs.json").body.find("a.glb"), std::string::npos);
  EXPECT_EQ(connection.get("/packs/a.glb").body, single_);
  folder_.write("packs/plain.glb", "glTF, but no pack");
  EXPECT_EQ(connection.get("/packs.json").body.find("plain.glb"), std::string::npos);
}

TEST_F(ServerTest, GivesRanges) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const RawResponse whole = connection.get(url_);
  EXPECT_EQ(whole.status, 200);
  EXPECT_EQ(whole.body, pack_);
  EXPECT_EQ(whole.fields.at("content-type"), "model/gltf-binary");
  EXPECT_EQ(whole.fields.at("accept-ranges"), "bytes");
  EXPECT_EQ(whole.fields.at("access-control-allow-origin"), "*");
  EXPECT_EQ(whole.fields.at("access-control-expose-headers"), "Content-Range, ETag, Accept-Ranges");

  const RawResponse part = connection.get(url_, "Range: bytes=1000-1999\r\n");
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, pack_.substr(1000, 1000));
  EXPECT_EQ(part.fields.at("content-range"), "bytes 1000-1999/" + total_);
  EXPECT_EQ(connection.get(url_, "Range: bytes=-10\r\n").body, pack_.substr(pack_.size() - 10));
  EXPECT_EQ(connection.get(url_, "Range: bytes=" + std::to_string(pack_.size() - 10) + "-\r\n").body,
            pack_.substr(pack_.size() - 10));
  EXPECT_EQ(connection.get(url_, "Range: bytes=0-1,5-6\r\n").status, 200);
  const RawResponse beyond = connection.get(url_, "Range: bytes=" + total_ + "-\r\n");
  EXPECT_EQ(beyond.status, 416);
  EXPECT_EQ(beyond.fields.at("content-range"), "bytes */" + total_);
}

TEST_F(ServerTest, HeadHasNoBody) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const RawResponse head = connection.get(url_, "", "HEAD");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.fields.at("content-length"), total_);
  EXPECT_EQ(connection.get("/healthz").body, "ok\n") << "the next answer follows directly";
  for (const char* range : {"Range: bytes=0-9\r\n", "Range: bytes=99999999-\r\n"}) {
    const RawResponse whole = connection.get(url_, range, "HEAD");
    EXPECT_EQ(whole.status, 200) << "a range has a meaning for GET alone";
    EXPECT_EQ(whole.fields.at("content-length"), total_);
    EXPECT_EQ(whole.fields.count("content-range"), 0u);
  }
}

TEST_F(ServerTest, TagsTellAReplacedFile) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const std::string before = connection.get(url_, "Range: bytes=0-9\r\n").fields.at("etag");
  EXPECT_EQ(before.front(), '"') << "a strong tag";
  EXPECT_EQ(connection.get(url_, "Range: bytes=0-9\r\nIf-Range: " + before + "\r\n").status, 206);
  EXPECT_EQ(connection.get(url_, "If-None-Match: " + before + "\r\n").status, 304);
  const std::string other = pack_of(300001);
  folder_.write("packs/new", other);
  std::filesystem::rename(folder_.path() / "packs/new", folder_.path() / "packs/room one.lw.glb");
  const RawResponse after = connection.get(url_, "Range: bytes=0-9\r\nIf-Range: " + before + "\r\n");
  EXPECT_EQ(after.status, 200);
  EXPECT_NE(after.fields.at("etag"), before);
  EXPECT_EQ(after.body, other);
}

TEST_F(ServerTest, AsksForTheTagThatIsExpected) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const std::string tag = connection.get(url_, "", "HEAD").fields.at("etag");
  EXPECT_EQ(connection.get(url_, "Range: bytes=0-9\r\nIf-Match: \"x\", " + tag + "\r\n").status, 206);
  EXPECT_EQ(connection.get(url_, "If-Match: *\r\n", "HEAD").status, 200);
  EXPECT_EQ(connection.get(url_, "Range: bytes=0-9\r\nIf-Match: \"x\"\r\n").status, 412);
  EXPECT_EQ(connection.get(url_, "If-Match: W/" + tag + "\r\n").status, 412) << "a weak tag matches nothing";
  EXPECT_EQ(connection.get("/packs/absent.glb", "If-Match: *\r\n").status, 404);
}

TEST_F(ServerTest, SaysTheTime) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  for (const char* target : {"/healthz", "/absent", "/packs/single.glb"}) {
    const std::time_t before = std::time(nullptr);
    const std::string date = connection.get(target).fields.at("date");
    const std::time_t after = std::time(nullptr);
    EXPECT_TRUE(date == http_date(before) || date == http_date(after)) << date;
  }
}

class GzippedPage : public ServerTest {
 protected:
  GzippedPage() { write(script_); }
  void write(const std::string& script) { folder_.write("page/main.js", script); }

  /// What the gzip member says, at most so many bytes.
  static std::string inflated(const std::string& packed, size_t most = 1 << 20) {
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    std::string plain(most, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(plain.data());
    stream.avail_out = static_cast<uInt>(plain.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    plain.resize(stream.total_out);
    inflateEnd(&stream);
    return plain;
  }

  static constexpr const char* accepting = "Accept-Encoding: br, gzip\r\n";
  const std::string script_ = [] {
    std::string text;
    for (int i = 0; i < 5000; i++) text += "console.log(" + std::to_string(i) + ");\n";
    return text;
  }();
};

TEST_F(GzippedPage, ForThoseWhoAcceptIt) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const RawResponse plain = connection.get("/main.js");
  EXPECT_EQ(plain.body, script_);
  EXPECT_EQ(plain.fields.count("content-encoding"), 0u);
  EXPECT_EQ(plain.fields.at("vary"), "Accept-Encoding") << "or a cache gives one to who wants the other";
  for (int again = 0; again < 2; again++) {
    const RawResponse packed = connection.get("/main.js", accepting);
    EXPECT_EQ(packed.status, 200);
    EXPECT_EQ(packed.fields.at("content-encoding"), "gzip");
    EXPECT_EQ(packed.fields.at("vary"), "Accept-Encoding");
    EXPECT_EQ(packed.fields.at("content-type"), "text/javascript; charset=utf-8");
    EXPECT_NE(packed.fields.at("etag"), plain.fields.at("etag"));
    EXPECT_LT(packed.body.size(), script_.size() / 2);
    EXPECT_EQ(inflated(packed.body), script_);
    const RawResponse head = connection.get("/main.js", accepting, "HEAD");
    EXPECT_EQ(head.fields.at("content-length"), std::to_string(packed.body.size()));
    EXPECT_EQ(connection.get("/main.js", accepting + ("If-None-Match: " + packed.fields.at("etag") + "\r\n")).status,
              304);
  }
  EXPECT_EQ(connection.get("/main.js", "Accept-Encoding: gzip;q=0\r\n").body, script_);
}

TEST_F(GzippedPage, PartsAreOfTheFileAsItIs) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  const RawResponse part = connection.get("/main.js", std::string(accepting) + "Range: bytes=100-199\r\n");
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, script_.substr(100, 100));
  EXPECT_EQ(part.fields.at("content-range"), "bytes 100-199/" + std::to_string(script_.size()));
  EXPECT_EQ(part.fields.count("content-encoding"), 0u);
}

TEST_F(GzippedPage, PacksAndPicturesStayAsTheyAre) {
  folder_.write("page/logo.png", std::string(5000, 'x'));
  RunningServer server(options_);
  RawConnection connection(server.port());
  for (const char* target : {"/packs/single.glb", "/logo.png"}) {
    const RawResponse answer = connection.get(target, accepting);
    EXPECT_EQ(answer.fields.count("content-encoding"), 0u) << target;
    EXPECT_EQ(answer.fields.count("vary"), 0u) << target;
  }
}

TEST_F(GzippedPage, FollowsTheFile) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  EXPECT_EQ(inflated(connection.get("/main.js", accepting).body), script_);
  write(script_ + "more();");
  EXPECT_EQ(inflated(connection.get("/main.js", accepting).body), script_ + "more();");
}

TEST_F(GzippedPage, AFileThatGainsNothingOrIsLongStaysAsItIs) {
  write("js");
  RunningServer server(options_);
  RawConnection connection(server.port());
  EXPECT_EQ(connection.get("/main.js", accepting).body, "js");
  write(std::string(3 << 20, ' '));
  EXPECT_EQ(connection.get("/main.js", accepting).body.size(), size_t(3) << 20);
}

TEST_F(ServerTest, GivesNothingFromOutside) {
  RunningServer server(options_);
  for (const char* target :
       {"/../secret.glb", "/%2e%2e/secret.glb", "/core/../../secret.glb", "/core/%2e%2e%2f%2e%2e%2fsecret.glb",
        "//secret.glb", "/.hidden", "/link.glb", "/packs/../secret.glb", "/packs/..%2fsecret.glb", "/packs/notes.txt",
        "/packs/", "/packs", "/core", "/core/", "/main.js%00.glb", "/packs/%2fetc%2fpasswd", "/%zz", "/%2",
        "/core\\..\\main.js"}) {
    RawConnection connection(server.port());
    EXPECT_EQ(connection.get(target).status, 404) << target;
  }
  RawConnection connection(server.port());
  EXPECT_EQ(connection.get("secret.glb").status / 100, 4) << "a target without its slash";
}

TEST_F(ServerTest, RefusesOtherMethodsAndBodies) {
  RunningServer server(options_);
  RawConnection post(server.port());
  const RawResponse refused = post.get("/", "Content-Length: 3\r\n", "POST");
  EXPECT_EQ(refused.status, 405);
  EXPECT_EQ(refused.fields.at("allow"), "GET, HEAD, OPTIONS");
  RawConnection preflight(server.port());
  const RawResponse allowed = preflight.get("/packs.json", "Access-Control-Request-Headers: range\r\n", "OPTIONS");
  EXPECT_EQ(allowed.status, 204);
  EXPECT_EQ(allowed.fields.at("access-control-allow-headers"), "Range, If-Range, If-Match, If-None-Match");
}

TEST_F(ServerTest, RefusesLongAndBrokenHeaders) {
  RunningServer server(options_);
  RawConnection fat(server.port());
  EXPECT_EQ(fat.get("/", "X: " + std::string(20000, 'x') + "\r\n").status, 431);
  RawConnection broken(server.port());
  broken.send("GARBAGE\r\n\r\n");
  EXPECT_EQ(broken.receive().status, 400);
  EXPECT_TRUE(broken.ended());
}

TEST_F(ServerTest, UnderstandsATargetInAbsoluteForm) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  EXPECT_EQ(connection.get("http://example.org/packs/single.glb").body, single_);
  EXPECT_EQ(connection.get("HTTP://example.org:80" + url_ + "?x=://").body, pack_);
  EXPECT_EQ(connection.get("http://example.org").body, "<!doctype html>");
  EXPECT_EQ(connection.get("http://example.org?x=/secret").body, "<!doctype html>");
  EXPECT_EQ(connection.get("http://example.org/../secret.glb").status, 404);
  EXPECT_EQ(connection.get("/http://example.org/main.js").status, 404);
}

TEST_F(ServerTest, WantsOneHost) {
  RunningServer server(options_);
  for (const char* hosts : {"", "Host: a\r\nHost: a\r\n", "Host: a\r\nX: y\r\nhost: b\r\n"}) {
    RawConnection connection(server.port());
    connection.send("GET /healthz HTTP/1.1\r\n" + std::string(hosts) + "\r\n");
    EXPECT_EQ(connection.receive().status, 400) << hosts;
    EXPECT_TRUE(connection.ended()) << "who writes two hosts may mean two requests";
  }
  RawConnection old(server.port());
  old.send("GET /healthz HTTP/1.0\r\n\r\n");
  EXPECT_EQ(old.receive().status, 200);
}

TEST_F(ServerTest, KeepsConnectionsAlive) {
  RunningServer server(options_);
  RawConnection connection(server.port());
  for (int i = 0; i < 50; i++) ASSERT_EQ(connection.get(url_, "Range: bytes=7-9\r\n").body, pack_.substr(7, 3));
  connection.send(
      "GET /healthz HTTP/1.1\r\nHost: x\r\n\r\nGET /packs/single.glb HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(connection.receive().body, "ok\n");
  EXPECT_EQ(connection.receive().body, single_);
  EXPECT_TRUE(connection.ended());
}

TEST_F(ServerTest, WrongOptionsAreErrors) {
  const auto listens = [](ServerOptions options) { return Server::listen(options).has_value(); };
  ServerOptions options = options_;
  options.packs.push_back(folder_.path() / "absent.glb");
  EXPECT_FALSE(listens(options));
  options = options_;
  options.packs.push_back(folder_.write("plain.glb", "glTF, but no pack"));
  EXPECT_FALSE(listens(options));
  options = options_;
  options.packs.push_back(folder_.write("elsewhere/single.glb", single_));
  EXPECT_FALSE(listens(options)) << "two packs of one name";
  options = options_;
  options.page = folder_.path() / "absent";
  EXPECT_FALSE(listens(options));
  options = options_;
  options.bind = "nowhere";
  EXPECT_FALSE(listens(options));
  RunningServer server(options_);
  options = options_;
  options.port = server.port();
  EXPECT_FALSE(listens(options)) << "the port is taken";
}

}  // namespace
}  // namespace lightwell
