let radians degrees = degrees *. Float.pi /. 180.
let degrees radians = radians *. 180. /. Float.pi
