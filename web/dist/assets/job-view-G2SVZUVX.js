import{j as i}from"./chunk-U7U2WTVZ.js";function o({id:n}){return i("h1",{children:n})}export{o as JobView};
