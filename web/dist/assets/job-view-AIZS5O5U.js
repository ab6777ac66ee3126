import{h as i}from"./chunk-GYUW27G2.js";function o({id:n}){return i("h1",{children:n})}export{o as JobView};
