type t = string

let bad = "31"
let doubtful = "33"
let strong = "1"
let faint = "2"
let paint ~colour t text = if colour && text <> "" then Printf.sprintf "\027[%sm%s\027[0m" t text else text
