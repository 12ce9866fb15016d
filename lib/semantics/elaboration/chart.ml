type t = { value : Core.value; flawed : (string * string) list; notes : string list }

let names chart = match chart.value with Core.Map entries -> List.map fst entries | _ -> []
