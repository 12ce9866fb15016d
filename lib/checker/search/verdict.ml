type t = Holds | Violated | Inconclusive

let name = function Holds -> "holds" | Violated -> "violated" | Inconclusive -> "inconclusive"
