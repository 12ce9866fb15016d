let longest = 1e12
let is_one seconds = seconds >= 0. && seconds < longest

let none what seconds =
  if seconds >= longest then Printf.sprintf "%s takes a time of less than %g seconds, not %g" what longest seconds
  else Printf.sprintf "%s takes a time of 0 seconds or more, not %g" what seconds
