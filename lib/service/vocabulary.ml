type kind = Word | Procedure | Block | Setting | Maneuver | Member | Constant | Fleet_word
type entry = { name : string; kind : kind; form : string; text : string }

let entry kind (name, form, text) = { name; kind; form; text }

(* {1 Constructs} *)

let of_constructs kind =
  let kind_of : Dolphin_syntax.Construct.place -> kind = function
    | Begins | Limits | Begins_or_limits | Joins | Control | Defines | Declares | Constant -> Word
    | Procedure | Task_procedure -> Procedure
    | Block -> Block
  in
  let entry_of (word : Dolphin_syntax.Construct.word) =
    if kind_of word.place = kind then Some (entry kind (word.spelling, word.form, word.text)) else None in
  List.filter_map entry_of Dolphin_syntax.Construct.words

let words = of_constructs Word

let procedures =
  of_constructs Procedure
  @ List.map (entry Procedure)
    [ "position", "position(v)", "The vehicle's present position.";
      "battery", "battery(v)", "The charge left in the vehicle's battery, from 0 to 1.";
      "progress", "progress(v)", "The share of the way of its last plan that the vehicle has done, from 0 to 1.";
      "speed", "speed(v)", "The vehicle's speed over the ground, in metres per second.";
      "connected", "connected(v)", "Whether there is a link to the vehicle.";
      "reading", "reading(v, 'Temperature')", "The last value that the vehicle has reported of a quantity that it \
                                               measures.";
      "running", "running(v)", "Whether the vehicle runs a task now.";
      "now", "now()", "The whole seconds since the run started.";
      "timeOfDay", "timeOfDay()", "The seconds since midnight; `timeOfDay '21:30'` is those from midnight until then.";
      "eta", "eta(v, p)", "The seconds that the vehicle takes to a position, in a straight line.";
      "isNumber", "isNumber(x)", "Whether a value is a number.";
      "isString", "isString(x)", "Whether a value is a string.";
      "isList", "isList(x)", "Whether a value is a list or a range.";
      "isMap", "isMap(x)", "Whether a value is a map.";
      "location", "location(latitude, longitude)", "A position, in degrees; a third number is its height in metres. \
                                                    Also `location \"41\xc2\xb011.1'N 8\xc2\xb042.4'W\"`.";
      "polygon", "polygon([p1, p2, ...])",
      "The area inside the shortest lines from corner to corner; `holes: [[...], ...]` are left out.";
      "map", "map 'harbour.geojson'",
      "The areas, lines and positions on the map in this file, by name: GeoJSON, KML, KMZ, GPX, plans of \
       QGroundControl, missions of Neptus.";
      "fence", "fence inside harbour, margin: 20.m",
      "A limit for vehicles: `inside` or `outside` an area, at most a `depth` or a `height`, at least a `distance` \
       from each other. A plan that violates it fails.";
      "corridor", "corridor(path, width)", "The points at most half the width away from a path, a list of positions.";
      "along", "along(path, d)", "The position d metres along a path, a list of positions.";
      "coverage", "coverage(area, spacing: 40.m)",
      "The points of a way along parallel strips that cover an area, for `followPath`. Also `bearing: 30.degrees`, \
       `overlap: 10.percent` of a strip by the next one, `turn: 15.m` beyond the ends of strips.";
      "expandingSquare", "expandingSquare(datum, spacing: 50.m, radius: 200.m)",
      "The points of a search in squares around a position, for `followPath`; `bearing:` is that of its first leg.";
      "sector", "sector(datum, radius: 200.m)",
      "The points of a search in three triangles that meet at a position; `bearing:` is that of its first leg.";
      "spiral", "spiral(datum, spacing: 50.m, radius: 200.m)",
      "The points of a spiral around a position, which begins at `bearing:`.";
      "footprint", "footprint(altitude: 10.m, range: 50.m)",
      "The width of the strip that a sidescan of this range sees; a camera has an `angle` instead.";
      "area", "area(centre, radius)", "The circle around a position, its radius in metres. Also `centre ^ radius`." ]

let blocks =
  of_constructs Block @ [ entry Block ("pos", "pos { lat 41.18; lon 8.7.west }", "A position.") ]

let of_pick =
  List.map (entry Setting)
    [ "id", "id 'x8-02'", "This vehicle.";
      "type", "type 'UUV'", "Vehicles of this type.";
      "payload", "payload 'DVL', 'Sidescan'", "Vehicles that carry all of these devices.";
      "region", "region centre, radius", "Vehicles that are in this area now. Also `region area`.";
      "count", "count 3", "The number of vehicles; `_` is all in reach. 1 by default.";
      "timeout", "timeout 30.seconds", "The time to look for them; 0 is not at all." ]

let of_position =
  List.map (entry Setting)
    [ "lat", "lat 41.18", "Degrees north.";
      "latitude", "latitude 41.18", "Degrees north.";
      "lon", "lon 8.7.west", "Degrees east.";
      "longitude", "longitude 8.7.west", "Degrees east.";
      "height", "height 10", "Metres above the ellipsoid.";
      "hae", "hae 10", "Metres above the ellipsoid." ]

let of_plan =
  List.map (entry Setting)
    [ "planName", "planName 'name'", "The plan's name.";
      "description", "description 'text'", "The purpose of the plan.";
      "vehicles", "vehicles 'id', ...", "The vehicles that may run the plan.";
      "locate", "locate latitude, longitude",
      "The place of the next maneuver. Also `locate position`. At the top of a program: the place of plans without \
       one.";
      "move", "move north, east", "Moves the place of the next maneuver, in metres.";
      "speed", "speed 1.5, Speed.Units.METERS_PS", "The speed of the maneuvers that follow.";
      "z", "z 2, Z.Units.DEPTH", "The depth, altitude or height of the maneuvers that follow." ]

let maneuvers =
  List.map (entry Maneuver)
    [ "goTo", "goTo()", "Goes to the place.";
      "loiter", "loiter radius: 20, duration: 60, direction: 'VDEP'",
      "Circles around the place for this many seconds; 0 is without end.";
      "skeeping", "skeeping radius: 20, duration: 60",
      "Keeps within the radius of the place, drifting, for this many seconds; 0 is without end.";
      "yoyo", "yoyo max_depth: 20, min_depth: 2, pitch: 15.degrees",
      "Goes to the place, up and down on the way.";
      "popup", "popup duration: 180, currPos: true",
      "Comes to the surface for a fix: at its present position (`currPos`) or at the place.";
      "rows", "rows width: 100, length: 200, hstep: 27",
      "Parallel rows, the first along `bearing` (north) from the place, the others to the left of it: west. \
       To the right (east): `firstCurveRight: true`.";
      "followPath", "followPath points: [[north, east], ...]", "Goes along points, in metres from the place.";
      "compassCalibration", "compassCalibration radius: 5, duration: 300", "Circles to calibrate the compass.";
      "launch", "launch()", "Leaves the launcher." ]

let of_mission =
  List.map (entry Setting)
    [ "name", "name 'photos'", "The mission's name.";
      "vehicles", "vehicles 'id', ...", "The vehicles that may run the mission.";
      "arm", "arm true", "The vehicle may be armed in order to begin.";
      "speed", "speed 12", "Metres per second, from here on.";
      "altitude", "altitude 40", "Metres above home, from here on." ]

let items =
  List.map (entry Maneuver)
    [ "stored", "stored 'survey'", "Flies the stored mission of this name here.";
      "home", "home p", "The home position; without an argument, here.";
      "takeOff", "takeOff 30", "Takes off to this many metres above home.";
      "takeOffWithYaw", "takeOffWithYaw 30, 90", "Takes off, and turns to this course.";
      "goPos", "goPos p, altitude: 40, speed: 12", "Goes to a position. Also `goPos latitude, longitude`.";
      "move", "move north, east, up", "Goes this many metres from its position then. Also `move p, { north 10 }`.";
      "moveFromHome", "moveFromHome north, east", "Goes to a point this many metres from home.";
      "moveAndLoiter", "moveAndLoiter north, east, duration: 1.minute", "Goes there and circles.";
      "returnHome", "returnHome()", "Goes home.";
      "returnHomeAndLoiter", "returnHomeAndLoiter 1.minute", "Goes home and circles; 0 is without end.";
      "returnHomeAndLand", "returnHomeAndLand()", "Goes home and lands.";
      "landingPoint", "landingPoint p", "Lands there; without a position, where the vehicle is then.";
      "loiterPos", "loiterPos p, duration: 1.minute, radius: 40", "Circles around a position, without end by default.";
      "loiterTurns", "loiterTurns 3, p", "Circles this number of times.";
      "loiterTime", "loiterTime 1.minute, p", "Circles for this time.";
      "delay", "delay 10.seconds", "Stays for this time.";
      "capturePhoto", "capturePhoto()", "Takes a photo.";
      "captureSeveralPhotos", "captureSeveralPhotos 10, 2.seconds", "Takes photos, with this time between two.";
      "captureUntilStop", "captureUntilStop 2.seconds", "Takes photos until `stopCapturing`.";
      "stopCapturing", "stopCapturing()", "Takes no more photos.";
      "jumpToItem", "jumpToItem 2, 3", "Continues with this item, this number of times; -1 is always.";
      "surveyArea", "surveyArea([p, q, r], 20, bearing: 45)", "Covers an area by lines at this distance in metres." ]

let settings : Dolphin_syntax.Ast.builder -> entry list = function
  | Pick -> of_pick
  | Recruit -> List.filter (fun e -> e.name <> "count" && e.name <> "timeout") of_pick
  | Pos -> of_position
  | Imc_plan -> of_plan @ maneuvers
  | Mission -> of_mission @ items
  | All_of | One_of -> List.filter (fun e -> e.name = "when") words

let members =
  List.map (entry Member)
    [ "size", "xs.size()", "The number of elements or characters.";
      "isEmpty", "xs.isEmpty()", "Whether it is empty.";
      "contains", "xs.contains(x)", "Whether x is in it.";
      "each", "xs.each { ... }", "Runs the code for each element.";
      "eachWithIndex", "xs.eachWithIndex { x, i -> ... }", "Runs the code for each element and its index, from 0.";
      "collect", "xs.collect { ... }", "The values that the code gives for each element.";
      "findAll", "xs.findAll { ... }", "The elements for which the code is true.";
      "find", "xs.find { ... }", "The first element for which the code is true, or null.";
      "any", "xs.any { ... }", "Whether the code is true for any element.";
      "every", "xs.every { ... }", "Whether the code is true for all elements.";
      "count", "xs.count { ... }", "The number of elements for which the code is true.";
      "inject", "xs.inject(start) { sum, x -> ... }", "The result of the code for the start and each element in turn.";
      "get", "xs.get(i)", "The element at an index from 0, or of a key.";
      "first", "xs.first()", "The first element.";
      "last", "xs.last()", "The last element.";
      "head", "xs.head()", "The first element.";
      "tail", "xs.tail()", "All but the first element.";
      "take", "xs.take(n)", "The first n.";
      "drop", "xs.drop(n)", "All but the first n.";
      "indexOf", "xs.indexOf(x)", "The index of x, from 0; -1 if x is not in it.";
      "reverse", "xs.reverse()", "In reverse order.";
      "sort", "xs.sort { key }", "In order, by the key that the code gives.";
      "unique", "xs.unique()", "Each value once.";
      "sum", "xs.sum()", "The sum.";
      "max", "xs.max()", "The largest; `max { }` by a key.";
      "min", "xs.min()", "The least; `min { }` by a key.";
      "join", "xs.join(', ')", "A string of all, with the text between them.";
      "toList", "xs.toList()", "A list of the elements.";
      "add", "xs.add(x)", "Gives the variable xs with x at its end.";
      "addAll", "xs.addAll(ys)", "Gives the variable xs with all of ys at its end.";
      "remove", "xs.remove(i)", "Gives the variable xs without the element at i; of a map, without a key.";
      "clear", "xs.clear()", "Empties the variable.";
      "containsKey", "m.containsKey(k)", "Whether the map has the key.";
      "keys", "m.keys()", "The keys of a map.";
      "values", "m.values()", "The values of a map.";
      "put", "m.put(k, x)", "Gives the map in the variable x under the key k.";
      "toUpperCase", "s.toUpperCase()", "In capital letters.";
      "toLowerCase", "s.toLowerCase()", "In small letters.";
      "trim", "s.trim()", "Without blanks at its ends.";
      "startsWith", "s.startsWith(t)", "Whether it begins with t.";
      "endsWith", "s.endsWith(t)", "Whether it ends with t.";
      "replace", "s.replace(t, u)", "With u for each t.";
      "split", "s.split(t)", "The parts between the t.";
      "substring", "s.substring(i, j)", "The characters from i to before j.";
      "toInteger", "s.toInteger()", "The whole number that it spells; of a number, its whole part.";
      "toDouble", "s.toDouble()", "The number that it spells.";
      "abs", "n.abs()", "Without its sign.";
      "round", "n.round(digits)", "Rounded to this number of digits, or to a whole number.";
      "times", "n.times { ... }", "Runs the code n times.";
      "id", "v.id", "The vehicle's id, or the plan's name.";
      "ids", "vs.ids", "The ids of the vehicles.";
      "type", "v.type", "The vehicle's type.";
      "position", "v.position", "The vehicle's present position.";
      "battery", "v.battery", "The charge left in the vehicle's battery, from 0 to 1.";
      "payload", "v.payload", "The vehicle's devices.";
      "latitude", "p.latitude", "Degrees north.";
      "longitude", "p.longitude", "Degrees east.";
      "height", "p.height", "Metres above the ellipsoid.";
      "distance", "p.distance(q)", "Metres from p to q.";
      "bearing", "p.bearing(q)", "Degrees from the north.";
      "displace", "p.displace(north, east)", "The position at this distance in metres.";
      "centre", "a.centre", "The centre of an area.";
      "radius", "a.radius", "The radius of a circle in metres.";
      "size", "a.size", "The size of an area in square metres.";
      "corners", "a.corners", "The corners of an area, rim by rim.";
      "bounds", "a.bounds", "The south-west and the north-east corner of an area's box.";
      "hull", "a.hull()", "The smallest convex area around an area.";
      "offset", "a.offset(d)", "The points at most d metres away from an area; for d below 0, the points at least -d \
                                inside.";
      "grid", "a.grid(d)", "The middles of squares of d metres that are in an area.";
      "split", "a.split(3)", "This number of parts of an area, equally large and each connected; of a string, its \
                              pieces.";
      "length", "p.length",
      "The metres from the first place of a plan to its last; `p.length(v)`: from the vehicle's position.";
      "duration", "p.duration(v)", "The seconds that the plan takes the vehicle, from its position on.";
      "energy", "p.energy(v)", "The share of the vehicle's battery that the plan takes, from its position on, from 0 \
                                to 1.";
      "rest", "p.rest(v)", "The part of a plan that the vehicle has not done; `p.rest(0.5)`: all but this share \
                            of its way.";
      "name", "t.name", "The name of a plan.";
      "call", "f.call(...)", "The value of the closure." ]

let units =
  let text unit =
    match Dolphin_semantics.Operators.unit_factor unit with
    | Some factor -> Printf.sprintf "A number of this unit is that number times %g." factor
    | None -> "A unit." in
  List.map (fun unit -> entry Constant (unit, "2." ^ unit, text unit)) Dolphin_semantics.Operators.unit_names

let constants =
  let constant name = entry Constant (name, name, "A constant.") in
  let math name = entry Procedure ("Math." ^ name, Printf.sprintf "Math.%s(...)" name, "A function of numbers.") in
  List.map constant Dolphin_semantics.Builtins.constants @ List.map math Dolphin_semantics.Builtins.math_names

let fleet_entries =
  List.map (entry Fleet_word)
    [ "vehicle", "vehicle 'id', { type 'UUV' }", "A vehicle of the world.";
      "plan", "plan 'name', { duration 3.min }", "The outcome and the duration of a plan.";
      "answer", "answer 'prompt', e1, e2", "People's answers to a prompt, one after another.";
      "input", "input 'key', x1, x2", "Values that may be posted with a key from outside, one after another.";
      "field", "field 'Temperature', 12, at(41.185, -8.706)", "The value of a quantity at a place, from a time on.";
      "fence", "fence inside map('harbour.geojson').basin, margin: 20.m", "A limit that always holds for vehicles.";
      "locate", "locate 41.185, -8.706", "The place of plans, in programs without one.";
      "assume", "assume eventually { battery('x8-02') > 0.8 }", "A reading that recurs where programs look for it.";
      "reply", "reply 'call', r1, r2", "A supplier's replies to a call, one after another." ]

let of_vehicle =
  List.map (entry Setting)
    [ "type", "type 'UUV'", "The vehicle's type.";
      "payload", "payload 'DVL', 'Sidescan'", "Its devices.";
      "at", "at 41.185, -8.706", "Its position; several are all places where it is ever seen.";
      "speed", "speed 1.5", "Metres per second.";
      "battery", "battery 80.percent", "The charge of its battery; `unknown` if it does not report it.";
      "shows", "shows 'Temperature', 12, 18", "A quantity that it measures, and its possible values.";
      "drain", "drain 10.percent", "The share of the battery that an hour's work takes.";
      "charge", "charge 50.percent", "The share of the battery that an hour's rest gives.";
      "charger", "charger 41.185, -8.706, 30.m", "A place: rest charges only within this distance.";
      "joins", "joins 30.seconds", "The time at which it comes.";
      "leaves", "leaves 10.min", "The time at which it goes.";
      "drops", "drops 2.min, 30.seconds", "The time at which its link falls silent, and for how long." ]

let of_fleet_plan =
  List.map (entry Setting)
    [ "duration", "duration 3.min, 9.min", "Its duration: a time, or the shortest and the longest.";
      "mayFail", "mayFail 20.percent", "It fails now and then.";
      "fails", "fails", "It always fails.";
      "at", "at 41.186, -8.705", "The place where it is run.";
      "only", "only 'UAV', 'x8-02'", "Types and ids of the vehicles that know it.";
      "charges", "charges 120.percent", "The share of the battery that an hour of it gives, instead of draining it." ]

let fleet_settings = function
  | "vehicle" -> of_vehicle
  | "plan" -> of_fleet_plan
  | _ -> []

let all =
  words @ procedures @ blocks @ of_pick @ of_position @ of_plan @ maneuvers @ of_mission @ items
  @ constants @ members @ units
  @ fleet_entries @ of_vehicle @ of_fleet_plan

let find name = List.filter (fun entry -> entry.name = name) all
