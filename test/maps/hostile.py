"""Archives and texts that are meant to do harm, and two good archives, in the current folder."""

import json
import struct
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


def overlapping(name, times, size):
    """An archive that names the same packed bytes many times: they unpack to nothing, slowly."""
    packed = b"\x00\x00\x00\xff\xff" * (size // 5) + b"\x01\x00\x00\xff\xff"
    path = b"a.kml"
    file = struct.pack("<IHHHHHIIIHH", 0x04034B50, 20, 0, 8, 0, 0, 0, len(packed), 0, len(path), 0) + path + packed
    entry = struct.pack("<IHHHHHHIIIHHHHHII", 0x02014B50, 20, 20, 0, 8, 0, 0, 0, len(packed), 0, len(path), 0, 0, 0, 0,
                        0, 0) + path
    end = struct.pack("<IHHHHIIH", 0x06054B50, 0, 0, times, times, len(entry) * times, len(file), 0)
    with open(name, "wb") as archive:
        archive.write(file + entry * times + end)


overlapping("overlap.kmz", 60_000, 10_000_000)
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
laughs = "".join(f'<!ENTITY l{i} "{("&l%d;" % (i - 1)) * 10}">' for i in range(1, 10))
write("laughs.kml", f'<!DOCTYPE kml [<!ENTITY l0 "lol">{laughs}]>\n<kml><Placemark><name>&l9;</name></Placemark></kml>')
write("laughs.gpx", f'<!DOCTYPE gpx [<!ENTITY l0 "lol">{laughs}]>\n<gpx><wpt lat="&l9;" lon="0"/></gpx>')
write("parameter.kml", '<!DOCTYPE kml [<!ENTITY % x SYSTEM "file:///etc/passwd"> %x;]>\n<kml/>')


def strip(i, count, lies):
    low, high = i * 0.02 / count, (i + 0.5) * 0.02 / count
    corners = [[0, low], [0.02, low], [0.02, high], [0, high], [0, low]]
    return [corners if lies else [[y, x] for x, y in corners]]


def geometry(name, kind, coordinates):
    write(name, json.dumps({"type": kind, "coordinates": coordinates}))


geometry("lattice.geojson", "MultiPolygon", [strip(i, 20_000, lies) for lies in (True, False) for i in range(20_000)])
geometry("ringless.geojson", "Polygon", [])
geometry("cornerless.geojson", "Polygon", [[]])
geometry("flat.geojson", "Polygon", [[[0, 0], [0.001, 0], [0.002, 0], [0, 0]]])
geometry("nothing.geojson", "MultiPolygon", [])
geometry("bow.geojson", "Polygon", [[[0, 0], [0.001, 0.001], [0.001, 0], [0, 0.001], [0, 0]]])
geometry("beyond.geojson", "Polygon", [[[0, 89], [120, 89], [240, 89], [0, 89]]])
geometry("world.geojson", "Polygon", [[[-180, -90], [180, -90], [180, 90], [-180, 90], [-180, -90]]])
write("endless.geojson", '{"type":"Point","coordinates":[1e999,0]}')
geometry("pole.geojson", "Polygon", [[[0, 89.99], [120, 89.99], [-120, 89.99], [0, 89.99]]])
geometry("antimeridian.geojson", "Polygon", [[[179.99, 0], [-179.99, 0], [-179.99, 0.01], [179.99, 0.01], [179.99, 0]]])
write("large.nmap", MAP.replace("pier", " " * 20_000_000))
archive("large.nmisz", ("maps/a.nmap", MAP.replace("pier", " " * 20_000_000)))
with open("large.geojson", "wb") as file:
    file.truncate(100_000_000)
