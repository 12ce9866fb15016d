let knot = 1852. /. 3600.

let all =
  [ ("m", 1.); ("meter", 1.); ("meters", 1.); ("metre", 1.); ("metres", 1.);
    ("km", 1000.); ("kilometer", 1000.); ("kilometers", 1000.); ("kilometre", 1000.); ("kilometres", 1000.);
    ("second", 1.); ("seconds", 1.); ("sec", 1.); ("ms", 0.001); ("milliseconds", 0.001);
    ("min", 60.); ("minute", 60.); ("minutes", 60.); ("hour", 3600.); ("hours", 3600.);
    ("day", 86400.); ("days", 86400.);
    ("nauticalMile", 1852.); ("nauticalMiles", 1852.); ("foot", 0.3048); ("feet", 0.3048); ("fathom", 1.8288);
    ("fathoms", 1.8288); ("knot", knot); ("knots", knot);
    ("degree", 1.); ("degrees", 1.); ("radian", 180. /. Float.pi); ("radians", 180. /. Float.pi);
    ("north", 1.); ("east", 1.); ("south", -1.); ("west", -1.);
    ("percent", 0.01) ]

let factor name = List.assoc_opt name all
let names = List.map fst all
