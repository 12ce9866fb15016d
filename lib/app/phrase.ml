let count n what = Printf.sprintf "%d %s%s" n what (if n = 1 then "" else "s")
