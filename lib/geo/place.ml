let at latitude longitude : Position.t = { latitude; longitude; height = 0. }

let apdl = at 41.185242 (-8.704803)

let feup = at 41.1781918 (-8.5954308)

let all = [ ("APDL", apdl); ("FEUP", feup) ]

let find name = List.assoc_opt name all
