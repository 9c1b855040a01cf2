"""Nobody passes the gate without the token, and with its cookie everything passes."""

import gzip
import http.client
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest

from pat3d.studio.gate import COOKIE, Gate, is_loopback
from pat3d.studio.page import LOADING, PLAINER, page

TOKEN = "a-token-that-is-secret"


class Inner(BaseHTTPRequestHandler):
    def do_GET(self):
        body = b"x" * 300_000
        self.send_response(200)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def gate():
    inner = ThreadingHTTPServer(("127.0.0.1", 0), Inner)
    threading.Thread(target=inner.serve_forever, daemon=True).start()
    made = Gate("127.0.0.1", 0, inner=inner.server_address[1], token=TOKEN)
    yield made
    made.close()
    inner.shutdown()
    inner.server_close()


def get(gate, path="/", **headers):
    client = http.client.HTTPConnection("127.0.0.1", gate.port, timeout=30)
    client.request("GET", path, headers=headers)
    answer = client.getresponse()
    body = answer.read()
    client.close()
    return answer, body


@pytest.mark.parametrize(
    ("path", "headers"),
    [
        ("/", {}),
        ("/?token=", {}),
        ("/?token=wrong", {}),
        ("/", {"Cookie": f"{COOKIE}=wrong"}),
        ("/", {"Cookie": f"other={TOKEN}"}),
    ],
)
def test_without_the_token_nobody_passes(gate, path, headers):
    answer, body = get(gate, path, **headers)
    assert answer.status == 401
    assert b"x" * 10 not in body


def test_the_token_is_exchanged_for_a_cookie_that_scripts_cannot_read(gate):
    answer, _ = get(gate, f"/?token={TOKEN}")
    assert (answer.status, answer.headers["Location"]) == (303, "/")
    cookie = answer.headers["Set-Cookie"]
    assert cookie.startswith(f"{COOKIE}={TOKEN};")
    assert "HttpOnly" in cookie
    assert "SameSite=Strict" in cookie


def test_with_the_cookie_everything_passes(gate):
    answer, body = get(gate, "/", Cookie=f"{COOKIE}={TOKEN}")
    assert answer.status == 200
    assert len(body) == 300_000


def test_a_page_of_somebody_else_does_not_pass_with_the_cookie(gate):
    answer, _ = get(gate, "/", Cookie=f"{COOKIE}={TOKEN}", Origin="http://elsewhere.example")
    assert answer.status == 403


def test_what_is_too_long_is_dropped(gate):
    with pytest.raises((http.client.HTTPException, OSError)):
        get(gate, "/", Cookie="a" * 200_000)


@pytest.fixture
def open_gate(gate):
    made = Gate("127.0.0.1", 0, inner=gate.inner, token=None)
    yield made
    made.close()


def test_without_a_token_only_its_own_page_passes(open_gate):
    """Browsers say which page a connection is of; names of somebody else for this machine are refused."""
    own = f"127.0.0.1:{open_gate.port}"
    assert get(open_gate)[0].status == 200
    assert get(open_gate, Origin=f"http://{own}")[0].status == 200
    assert get(open_gate, Origin="http://elsewhere.example")[0].status == 403
    assert get(open_gate, Origin="null")[0].status == 403
    assert get(open_gate, Host="rebound.example", Origin="http://rebound.example")[0].status == 403


@pytest.mark.parametrize(("host", "local"), [("127.0.0.1", True), ("localhost", True), ("0.0.0.0", False), ("", False)])
def test_only_the_loopback_needs_no_token(host, local):
    assert is_loopback(host) is local


@pytest.fixture(scope="module")
def paged(gate):
    made = Gate("127.0.0.1", 0, inner=gate.inner, token=TOKEN, page=lambda: gzip.compress(b"the page"))
    yield made
    made.close()


def test_who_passes_gets_the_page_and_everything_else_from_within(paged):
    known = {"Cookie": f"{COOKIE}={TOKEN}", "Accept-Encoding": "gzip"}
    answer, body = get(paged, "/?fixedDpr=1", **known)
    assert (answer.status, answer.headers["Content-Encoding"]) == (200, "gzip")
    assert gzip.decompress(body) == b"the page"
    assert get(paged, "/else.js", **known)[1] == b"x" * 300_000
    # A program that does not know gzip gets what is within.
    assert get(paged, "/", Cookie=known["Cookie"])[1] == b"x" * 300_000
    assert get(paged, "/", **{"Accept-Encoding": "gzip"})[0].status == 401


def test_the_page_is_that_of_viser_and_two_things_more():
    pytest.importorskip("viser")
    html = gzip.decompress(page()).decode()
    assert html.count(PLAINER) == html.count(LOADING) == 1
    assert html.index(PLAINER) < html.index("</head>") < html.index(LOADING)
