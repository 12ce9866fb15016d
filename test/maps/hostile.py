"""Archives and texts that are meant to do harm, and two good archives, in the current folder."""

import zipfile

PLACE = '<Placemark><name>{}</name><Point><coordinates>-8,41</coordinates></Point></Placemark>'
MAP = """<map><features><mark><id>pier</id><coordinate><latitude>41N30'0''</latitude><longitude>8W15'0''</longitude>
<depth>2</depth></coordinate></mark></features></map>"""


def archive(name, *files):
    with zipfile.ZipFile(name, "w", zipfile.ZIP_DEFLATED) as z:
        for path, text in files:
            z.writestr(path, text)


def write(name, text):
    with open(name, "w") as file:
        file.write(text)


archive("good.kmz", ("files/picture.png", b"\x89PNG"), ("doc.kml", "<kml>" + PLACE.format("deck") + "</kml>"))
archive("good.nmisz", ("mission.nmis", "<mission-def/>"), ("maps/a.nmap", MAP), ("maps/b.nmap", MAP))
archive("bomb.kmz", ("doc.kml", b" " * 200_000_000))
archive("many.kmz", *[(f"../evil{i}.kml", b"<kml>" + b" " * 5_000_000 + b"</kml>") for i in range(8)])
archive("none.kmz", ("picture.png", b"\x89PNG"))

good = open("good.kmz", "rb").read()
open("torn.kmz", "wb").write(good[:40] + b"\xff" * 60 + good[100:])
flags = bytearray(good)
for signature, offset in [(b"PK\x03\x04", 6), (b"PK\x01\x02", 8)]:
    at = -1
    while (at := flags.find(signature, at + 1)) >= 0:
        flags[at + offset] |= 1
open("encrypted.kmz", "wb").write(flags)

write("entity.kml", '<!DOCTYPE kml [<!ENTITY a "lol"><!ENTITY b "&a;&a;&a;&a;">]>\n<kml><Placemark><name>&b;</name>'
      "</Placemark></kml>")
write("external.kml", '<!DOCTYPE kml [<!ENTITY x SYSTEM "file:///etc/passwd">]>\n<kml><Placemark><name>secret&x;</name>'
      "</Placemark></kml>")
write("deep.kml", "<kml>" + "<a>" * 3_000_000)
write("deep.geojson", "[" * 10_000_000)
with open("large.geojson", "wb") as file:
    file.truncate(100_000_000)
