from course_tool.pip_settings import for_uv


def test_the_usual_index_needs_no_word():
    assert for_uv("global.index-url='https://pypi.org/simple'\n", {}) == {}


def test_an_index_of_ones_own_is_passed_on():
    found = for_uv("global.index-url='https://mirror.example/simple'\n", {})
    assert found == {"UV_DEFAULT_INDEX": "https://mirror.example/simple"}


def test_the_closer_setting_counts():
    listing = (
        ":env:.index-url='https://three.example'\n"
        "global.index-url='https://one.example'\n"
        "install.index-url='https://two.example'\n"
    )
    assert for_uv(listing, {}) == {"UV_DEFAULT_INDEX": "https://three.example"}


def test_what_was_said_to_uv_itself_stays():
    listing = "global.index-url='https://mirror.example'\nglobal.proxy='http://p:1'\n"
    assert for_uv(listing, {"UV_INDEX_URL": "https://x", "HTTPS_PROXY": "http://q:2"}) == {}


def test_certificates_proxies_and_trusted_hosts():
    listing = (
        "global.cert='/etc/my certs.pem'\n"
        "global.proxy='http://proxy.example:3128'\n"
        "global.trusted-host='\\none.example\\ntwo.example'\n"
    )
    assert for_uv(listing, {}) == {
        "SSL_CERT_FILE": "/etc/my certs.pem",
        "ALL_PROXY": "http://proxy.example:3128",
        "UV_INSECURE_HOST": "one.example two.example",
    }


def test_other_lines_are_passed_over():
    assert for_uv("global.timeout='60'\nWARNING: nonsense\n:env:.quiet='1'\n", {}) == {}
