let is_mathematics name = List.mem name [ "abs"; "max"; "min"; "round"; "floor"; "ceil"; "signum" ]

let is_refused_property name =
  List.mem name [ "latitude"; "lat"; "longitude"; "lon"; "height"; "radian"; "radians" ]

let is_for_readings name =
  List.mem name
    [ "latitude"; "lat"; "longitude"; "lon"; "height"; "getLatitude"; "getLongitude"; "getHeight"; "bearing";
      "bearingTo" ]

let is_refused_method name =
  List.mem name
    [ "toUpperCase"; "toUpper"; "capitalize"; "equalsIgnoreCase"; "trim"; "endsWith"; "replace"; "split"; "toFloat";
      "toBigDecimal"; "isNumber"; "padLeft"; "padRight"; "substring"; "bearing"; "bearingTo"; "displace";
      "getLatitude"; "getLongitude"; "getHeight" ]
