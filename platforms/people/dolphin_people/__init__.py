"""People as vehicles of the platform protocol, on the package `dolphin`.

`configuration` reads people.yaml; `person` has the rules of an instruction, from the offer to the report; `answers`
posts each answer to the run once; `http` is a server of requests with h11, `site` its replies; `shell` is the process,
and `terminal` a page for those without a browser.
"""

version = "0.1"
