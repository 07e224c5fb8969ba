"""The page: HTML, CSS and JavaScript, put together by `contactkit.live_page.page`."""
