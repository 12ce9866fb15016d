open Dolphin_geo

let speed ~kind = if String.uppercase_ascii kind = "UAV" then 18. else 1.5
let battery = 1.
let drain = 0.1
let failure = 0.1
let anchorage : Position.t = { latitude = 41.18500; longitude = -8.70620; height = 0. }

let position n =
  let spacing = 20. in
  Wgs84.displace anchorage ~north:(spacing *. float (n mod 10)) ~east:(-.spacing *. float (n / 10))
